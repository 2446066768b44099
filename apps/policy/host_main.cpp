// The program dmpc_policy_host, which dmpc starts: simulates caches with a shared library's policy, which may crash.

#include <dmpc/policy.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/frontend/system/module.h"
#include "apps/frontend/system/trusted_path.h"
#include "apps/policy/request.h"
#include "core/base/expect.h"
#include "svm/pages/observers/optimum.h"
#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

/// The current call, for crash reports.
struct UnderWay {
  const char* call = "";
  bool has_page = false;
  std::uint32_t page = 0, frame_count = 0, node = 0;
  std::uint64_t fault = 0;
};
UnderWay under_way;
volatile std::uint64_t calls = 0;  ///< that were begun

const PolicyTable* table = nullptr;
constexpr std::uint32_t priced_version = 2;  ///< from which on the table has price()

/// Concatenates words and numbers without allocating memory.
class Phrase {
 public:
  Phrase& operator<<(std::string_view words) {
    const std::size_t count = std::min(words.size(), room());
    at_ = std::copy_n(words.begin(), count, at_);
    return *this;
  }
  Phrase& operator<<(std::uint64_t number) {
    at_ = std::to_chars(at_, at_ + room(), number).ptr;
    return *this;
  }
  const char* text() {
    *at_ = '\0';
    return text_.data();
  }
  void begin() { at_ = text_.data(); }

 private:
  std::size_t room() const { return static_cast<std::size_t>(text_.data() + text_.size() - 1 - at_); }
  std::array<char, 256> text_{};
  char* at_ = text_.data();
};

/// Returns the policy's current call, "victim(page 7) of fault 12, with 3 frames of node 0", or "". Crash handlers may call it,
/// since it allocates no memory. The result is valid until the next call.
const char* policy_call_under_way() {
  static Phrase phrase;
  phrase.begin();
  phrase << under_way.call;
  if (under_way.has_page) {
    phrase << "(page " << under_way.page << ") of fault " << under_way.fault;
  }
  if (under_way.frame_count > 0) {
    phrase << ", with " << under_way.frame_count << " frames of node " << under_way.node;
  }
  return *under_way.call == '\0' ? "" : phrase.text();
}

/// Throws the policy's error message; passes on exceptions that it should not throw.
template <class Call>
void call(const char* name, const Call& made) {
  under_way.call = name;
  calls = calls + 1;
  const char* complaint = nullptr;
  std::string thrown;
  try {
    complaint = made();
  } catch (const std::exception& error) {  // the library does not use DMPC_POLICY
    thrown = error.what();
    complaint = thrown.c_str();
  } catch (...) {
    complaint = "it threw what is no std::exception";
  }
  if (complaint != nullptr) {
    throw core::InputError(std::string(policy_call_under_way()) + ": " + complaint);
  }
  under_way.call = "";
}

/// Consists of the library's calls, each with what is said of it if it does not come back well.
class LibraryPolicy final : public svm::ReplacementPolicy {
 public:
  LibraryPolicy(std::uint32_t frame_count, std::uint32_t node) : frame_count_(frame_count), node_(node) {
    begin(false, 0);
    call("make()", [&] { return table->make(frame_count, node, &policy_); });
  }
  ~LibraryPolicy() override {
    begin(false, 0);
    under_way.call = "drop()";
    table->drop(policy_);
    under_way.call = "";
  }
  LibraryPolicy(const LibraryPolicy&) = delete;
  LibraryPolicy& operator=(const LibraryPolicy&) = delete;

  /// Sets the price of the page that comes next.
  void set_price(std::uint32_t price) { price_ = price; }
  void hit(svm::PageId page, std::uint32_t frame) override {
    begin(true, index_of(page));
    call("hit", [&] { return table->hit(policy_, index_of(page), frame); });
  }
  void insert(svm::PageId page, std::uint32_t frame) override {
    tell_price(index_of(page));
    call("insert", [&] { return table->insert(policy_, index_of(page), frame); });
    has_come();
  }
  std::uint32_t victim(svm::PageId incoming) override {
    tell_price(index_of(incoming));
    std::uint32_t frame = frame_count_;
    call("victim", [&] { return table->victim(policy_, index_of(incoming), &frame); });
    if (frame == bypass) {
      has_come();
      return svm::bypass;
    }
    if (frame >= frame_count_) {
      under_way.call = "victim";
      throw core::InputError(std::string(policy_call_under_way()) + ": it says frame " + std::to_string(frame) +
                             ", expected one from 0 to " + std::to_string(frame_count_ - 1) + ", or bypass");
    }
    return frame;
  }

 private:
  void begin(bool has_page, std::uint32_t page) const {
    under_way = {.has_page = has_page, .page = page, .frame_count = frame_count_, .node = node_, .fault = fault_};
  }
  /// Once for each page that comes, before anything else of it.
  void tell_price(std::uint32_t page) {
    begin(true, page);
    if (!std::exchange(knows_price_, true) && table->version >= priced_version && table->price != nullptr) {
      call("price", [&] { return table->price(policy_, page, price_); });
    }
  }
  void has_come() {
    ++fault_;
    knows_price_ = false;
  }

  std::uint32_t frame_count_, node_;
  std::uint64_t fault_ = 1;
  std::uint32_t price_ = 1;
  bool knows_price_ = false;
  void* policy_ = nullptr;
};
static_assert(bypass == svm::bypass);

/// Throws core::InputError unless the library exports a policy of this version.
const PolicyTable* table_in(const std::string& path) {
  const Descriptor file = open_trusted(path);
  under_way.call = "the library's start";
  std::string complaint;
  void* const library = open_library("/proc/self/fd/" + std::to_string(file.number()), &complaint);
  under_way.call = "";
  if (library == nullptr) {
    throw core::InputError("it cannot be opened as a shared library: " + complaint);
  }
  const auto* const found = static_cast<const PolicyTable*>(exported_by(library, "dmpc_policy"));
  if (found == nullptr) {
    throw core::InputError(
        "it has no policy: expected the symbol dmpc_policy, as the line DMPC_POLICY(Class, \"name\") of "
        "<dmpc/policy.h> makes it");
  }
  if (found->version < 1 || found->version > policy_version) {
    throw core::InputError("its policy has version " + std::to_string(found->version) + " of the interface, expected 1 to " +
                           std::to_string(policy_version) + ": compile it with the <dmpc/policy.h> of this dmpc");
  }
  if (found->name == nullptr || found->make == nullptr || found->hit == nullptr || found->insert == nullptr ||
      found->victim == nullptr || found->drop == nullptr) {
    throw core::InputError("its policy lacks a name or a function: expected make, hit, insert, victim and drop");
  }
  return found;
}

/// One cache after the other.
class LibraryRun final : public svm::OwnPolicyRun {
 public:
  std::unique_ptr<svm::ReplacementPolicy> make(const svm::PolicySite& site) override {
    auto policy = std::make_unique<LibraryPolicy>(site.frame_count(), site.seed);
    latest_ = policy.get();
    return policy;
  }
  void finish() override {}
  /// The policy that was made last.
  LibraryPolicy& latest() { return *latest_; }

 private:
  LibraryPolicy* latest_ = nullptr;
};

using Answer = std::function<void(const void* bytes, std::size_t count)>;

/// Returns "FAULTS COST", of a cache of this size.
std::string faults_of(const PolicyRequest& request, std::uint32_t cache_pages) {
  LibraryRun run;
  std::uint64_t cost = 0;
  const auto pay = [&](std::size_t reference) {
    const std::uint32_t price = request.prices.empty() ? 1 : request.prices[reference];
    cost += price;
    if (cache_pages > 0) {
      run.latest().set_price(price);
    }
  };
  const std::uint64_t count = svm::policy_misses(run, request.references, cache_pages, request.task.node, pay);
  return std::to_string(count) + " " + std::to_string(cost);
}

void simulate(const PolicyRequest& request, const Answer& answer) {
  const auto say_line = [&answer](const std::string& line) { answer((line + '\n').data(), line.size() + 1); };
  say_line(table->name);
  for (const std::uint32_t cache_pages : request.cache_pages) {
    say_line(faults_of(request, cache_pages));
  }
}

/// Decides for the caches of a run, by node.
void follow_run(const Answer& answer) {
  std::map<std::uint32_t, LibraryPolicy> caches;
  for (std::vector<PolicyEvent> events; take_events(STDIN_FILENO, events);) {
    for (const PolicyEvent& event : events) {
      std::uint32_t said = 0;
      switch (event.kind()) {
        case PolicyEvent::Kind::make:
          caches.try_emplace(event.node(), event.page, event.node());
          break;
        case PolicyEvent::Kind::hit:
          caches.at(event.node()).hit(svm::PageId{event.page}, event.frame);
          break;
        case PolicyEvent::Kind::insert:
          caches.at(event.node()).insert(svm::PageId{event.page}, event.frame);
          break;
        case PolicyEvent::Kind::victim:
          said = caches.at(event.node()).victim(svm::PageId{event.page});
          [[fallthrough]];
        case PolicyEvent::Kind::sync:
          answer(&said, sizeof(said));
      }
    }
  }
}

bool is_done = false;

void say(const char* words) { static_cast<void>(!::write(STDERR_FILENO, words, std::strlen(words))); }

/// Allocates no memory, since it may run on a signal stack.
void report_of_end(const char* how) {
  const char* const call = policy_call_under_way();
  say(*call == '\0' ? "its library" : call);
  say(": ");
  say(how);
}

void report_of_crash(int signal) {
  report_of_end("it crashed (");
  say(signal == SIGSEGV  ? "SIGSEGV"
      : signal == SIGBUS ? "SIGBUS"
      : signal == SIGFPE ? "SIGFPE"
      : signal == SIGILL ? "SIGILL"
                         : "SIGABRT");
  say(")");
  ::_exit(1);
}

void report_of_exit() {
  if (!is_done) {
    report_of_end("it ended the process");
    ::_exit(1);
  }
}

/// Whether the policy is still in the call in which it was at the last look, all of whose time it took.
void look_for_hang(int /*signal*/) {
  static std::uint64_t calls_before = 0;
  if (*under_way.call != '\0' && calls == calls_before) {
    report_of_end("it does not come back");
    ::_exit(1);
  }
  calls_before = calls;
}

void watch_over_policy(std::uint32_t call_seconds) {
  static std::array<char, 65536> stack;
  const stack_t other{.ss_sp = stack.data(), .ss_flags = 0, .ss_size = stack.size()};
  ::sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = report_of_crash;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    ::sigaction(signal, &action, nullptr);
  }
  static_cast<void>(std::atexit(report_of_exit));
  action.sa_handler = look_for_hang;
  action.sa_flags = SA_ONSTACK | SA_RESTART;
  ::sigaction(SIGPROF, &action, nullptr);
  const timeval each{.tv_sec = static_cast<time_t>(call_seconds), .tv_usec = 0};
  const itimerval timer{.it_interval = each, .it_value = each};
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

/// Answers go to `output`, the original stdout; the library's own stdout goes to stderr. Throws core::InputError if the file may
/// not be opened (apps/frontend/system/trusted_path.h), is not a library, has no policy or one of another version, or if the
/// policy reports an error, throws, or returns an invalid frame.
void answer_to(int output, const std::string& path) {
  const PolicyRequest request = take_request(STDIN_FILENO);
  const Answer answer = [output](const void* bytes, std::size_t count) {
    core::expect(::write(output, bytes, count) == static_cast<ssize_t>(count), "answers are written");
  };
  watch_over_policy(request.task.call_seconds);
  table = table_in(path);
  request.task.is_of_run != 0 ? follow_run(answer) : simulate(request, answer);
}

}  // namespace

}  // namespace dmpc::apps

int main(int count, char** values) {
  int status = 0;
  try {
    if (count != 2) {
      throw dmpc::core::InternalError("dmpc_policy_host is started by dmpc alone, which tells it what to do");
    }
    const int output = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    dmpc::apps::answer_to(output, values[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::flush;
    status = 1;
  }
  dmpc::apps::is_done = true;
  ::_exit(status);  // skips the library's exit handlers
}
