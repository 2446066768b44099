// The program dmpc_policy_host, which dmpc starts: simulates caches with a shared library's policy, which may crash.

#include <dmpc/policy.h>
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
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/frontend/system/module.h"
#include "apps/frontend/system/trusted_path.h"
#include "apps/policy/request.h"
#include "core/base/expect.h"
#include "svm/pages/page.h"

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

class LibraryPolicy {
 public:
  LibraryPolicy(std::uint32_t frame_count, std::uint32_t node) {
    under_way = {.frame_count = frame_count, .node = node, .fault = 1};
    call("make()", [&] { return table->make(frame_count, node, &policy_); });
  }
  ~LibraryPolicy() {
    under_way.call = "drop()";
    under_way.has_page = false;
    table->drop(policy_);
    under_way.call = "";
  }
  LibraryPolicy(const LibraryPolicy&) = delete;
  LibraryPolicy& operator=(const LibraryPolicy&) = delete;

  void hit(std::uint32_t page, std::uint32_t frame) {
    about(page);
    call("hit", [&] { return table->hit(policy_, page, frame); });
  }
  void price(std::uint32_t page, std::uint32_t price) {
    if (table->version >= priced_version && table->price != nullptr) {
      about(page);
      call("price", [&] { return table->price(policy_, page, price); });
    }
  }
  void insert(std::uint32_t page, std::uint32_t frame) {
    about(page);
    call("insert", [&] { return table->insert(policy_, page, frame); });
    ++under_way.fault;
  }
  /// Nothing if the page bypasses the cache.
  std::optional<std::uint32_t> victim(std::uint32_t incoming) {
    about(incoming);
    std::uint32_t frame = under_way.frame_count;
    call("victim", [&] { return table->victim(policy_, incoming, &frame); });
    if (frame == bypass) {
      ++under_way.fault;
      return std::nullopt;
    }
    if (frame >= under_way.frame_count) {
      under_way.call = "victim";
      throw core::InputError(std::string(policy_call_under_way()) + ": it says frame " + std::to_string(frame) +
                             ", expected one from 0 to " + std::to_string(under_way.frame_count - 1) + ", or bypass");
    }
    return frame;
  }

 private:
  static void about(std::uint32_t page) {
    under_way.has_page = true;
    under_way.page = page;
  }
  void* policy_ = nullptr;
};

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

/// A cache of pages without bytes.
class LibraryCache {
 public:
  LibraryCache(const PolicyRequest& request, std::uint32_t frame_count)
      : request_(request), frame_count_(frame_count), frame_of_(svm::page_bound_of(request.references), nowhere) {}

  /// The answer's line.
  std::string faults() {
    std::optional<LibraryPolicy> policy;
    if (frame_count_ > 0) {
      policy.emplace(frame_count_, request_.node);
    }
    for (std::size_t i = 0; i < request_.references.size(); ++i) {
      const std::uint32_t page = index_of(request_.references[i]);
      const bool is_repeat = i > 0 && request_.references[i] == request_.references[i - 1];
      if (!policy || (!is_repeat && frame_of_[page] == nowhere)) {
        fault(i, policy);
      } else if (!is_repeat) {
        policy->hit(page, frame_of_[page]);
      }
    }
    return std::to_string(count_) + " " + std::to_string(cost_);
  }

 private:
  static constexpr std::uint32_t nowhere = 0xffffffffU;

  void fault(std::size_t reference, std::optional<LibraryPolicy>& policy) {
    const std::uint32_t price = request_.prices.empty() ? 1 : request_.prices[reference];
    ++count_;
    cost_ += price;
    if (!policy) {
      return;
    }
    const std::uint32_t page = index_of(request_.references[reference]);
    policy->price(page, price);
    std::optional<std::uint32_t> frame = static_cast<std::uint32_t>(pages_.size());
    if (pages_.size() < frame_count_) {
      pages_.push_back(page);
    } else if ((frame = policy->victim(page))) {
      frame_of_[std::exchange(pages_[*frame], page)] = nowhere;
    }
    if (frame) {
      frame_of_[page] = *frame;
      policy->insert(page, *frame);
    }
  }

  const PolicyRequest& request_;
  std::uint32_t frame_count_;
  std::vector<std::uint32_t> frame_of_;  ///< by page
  std::vector<std::uint32_t> pages_;     ///< by frame
  std::uint64_t count_ = 0, cost_ = 0;
};

/// Opens the library at `path` and passes to `answer` the policy's name, then the faults of each cache. Call it once in a
/// process. Throws core::InputError if the file may not be opened (apps/frontend/system/trusted_path.h), is not a library, has no
/// policy or one of another version, or if the policy reports an error, throws, or returns an invalid frame.
void answer_by_library(const std::string& path, const PolicyRequest& request,
                       const std::function<void(const std::string& line)>& answer) {
  table = table_in(path);
  answer(table->name);
  for (const std::uint32_t cache_pages : request.cache_pages) {
    answer(LibraryCache(request, cache_pages).faults());
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

void watch_over_crashes() {
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
}

/// Answers go to the original stdout; the library's own stdout goes to stderr.
void answer_to(int output, const std::string& path) {
  const PolicyRequest request = take_request(STDIN_FILENO);
  answer_by_library(path, request, [output](const std::string& line) {
    const std::string text = line + '\n';
    core::expect(::write(output, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "answers are written");
  });
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
    dmpc::apps::watch_over_crashes();
    dmpc::apps::answer_to(output, values[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::flush;
    status = 1;
  }
  dmpc::apps::is_done = true;
  ::_exit(status);  // skips the library's exit handlers
}
