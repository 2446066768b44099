#include "apps/policy/foreign_run.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "apps/frontend/system/resource_exhaustion.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Kind = PolicyEvent::Kind;
using Clock = std::chrono::steady_clock;

constexpr std::size_t batch_events = 4096;
/// Between two looks at how much it has printed, beside those while it is waited for.
constexpr std::uint64_t flushes_a_look = 4096;
constexpr int look_ms = 100;

/// One cache's policy.
class ForeignCache final : public svm::ReplacementPolicy {
 public:
  ForeignCache(ForeignRun& run, const svm::PolicySite& site) : run_(run), node_(site.seed), frame_count_(site.frame_count()) {
    run_.tell(PolicyEvent::of(node_, Kind::make, frame_count_));
  }
  void hit(svm::PageId page, std::uint32_t frame) override {
    run_.tell(PolicyEvent::of(node_, Kind::hit, index_of(page), frame));
  }
  void insert(svm::PageId page, std::uint32_t frame) override {
    run_.tell(PolicyEvent::of(node_, Kind::insert, index_of(page), frame));
  }
  std::uint32_t victim(svm::PageId incoming) override {
    const std::uint32_t frame = run_.ask(PolicyEvent::of(node_, Kind::victim, index_of(incoming)));
    return frame < frame_count_ || frame == svm::bypass ? frame : run_.refuse_answer();
  }

 private:
  ForeignRun& run_;
  std::uint32_t node_, frame_count_;
};

std::pair<Descriptor, Descriptor> make_socket() {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw ComputerCapacityError(std::string("there is no socket for a policy: ") + std::strerror(errno));
  }
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

}  // namespace

ForeignRun::ForeignRun(const PolicyPlace& place, std::function<void()> check)
    : place_(place), check_(std::move(check)), process_([&] {
        std::tie(its_, ours_) = make_socket();
        return process_settings(place_, its_.number(), its_.number());
      }()) {
  its_ = Descriptor();
  untold_.reserve(batch_events);
  core::expect(::fcntl(ours_.number(), F_SETFL, O_NONBLOCK) == 0, "a socket need not be waited for");
  reported_of(place_, [&] {
    put_request([this](const void* bytes, std::size_t count) { send(bytes, count); },
                {.is_of_run = 1, .call_seconds = place_.patience.call_seconds}, {}, {}, {}, place_.source);
  });
}

std::unique_ptr<svm::ReplacementPolicy> ForeignRun::make(const svm::PolicySite& site) {
  return std::make_unique<ForeignCache>(*this, site);
}

void ForeignRun::finish() { ask(PolicyEvent::of(0, Kind::sync)); }

void ForeignRun::tell(const PolicyEvent& event) {
  untold_.push_back(event);
  if (untold_.size() == batch_events) {
    reported_of(place_, [this] { flush(); });
  }
}

std::uint32_t ForeignRun::ask(const PolicyEvent& event) {
  untold_.push_back(event);
  reported_of(place_, [this] { flush(); });
  std::array<std::uint32_t, 2> answer{};
  if (reported_of(place_, [&] { return receive(&answer, sizeof(answer)); }) > sizeof(answer[0])) {
    refuse_answer();
  }
  return answer[0];
}

/// By its own process it would have been found out before.
std::uint32_t ForeignRun::refuse_answer() const {
  throw core::InputError(place_.option + "=" + place_.text + ": it answers in place of its process, expected a call of victim()");
}

void ForeignRun::flush() {
  const auto count = static_cast<std::uint32_t>(untold_.size());
  send(&count, sizeof(count));
  send(untold_.data(), untold_.size() * sizeof(PolicyEvent));
  untold_.clear();
  if (++flush_count_ % flushes_a_look == 0) {
    check_says_little(process_);
  }
}

void ForeignRun::send(const void* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t sent = ::send(ours_.number(), static_cast<const char*>(bytes) + done, count - done, MSG_NOSIGNAL);
    if (sent >= 0) {
      done += static_cast<std::size_t>(sent);
    } else if (errno == EAGAIN) {
      wait_for(POLLOUT);
    } else if (errno != EINTR) {
      fail();
    }
  }
}

/// Returns the number of bytes: at least those of an answer.
std::size_t ForeignRun::receive(void* answer, std::size_t count) {
  std::size_t done = 0;
  while (done < sizeof(std::uint32_t)) {
    const ssize_t taken = ::recv(ours_.number(), static_cast<char*>(answer) + done, count - done, 0);
    if (taken > 0) {
      done += static_cast<std::size_t>(taken);
    } else if (taken < 0 && errno == EAGAIN) {
      wait_for(POLLIN);
    } else if (taken == 0 || errno != EINTR) {
      fail();
    }
  }
  return done;
}

void ForeignRun::wait_for(short events) {
  const auto until = Clock::now() + std::chrono::seconds(place_.patience.answer_seconds);
  pollfd socket{.fd = ours_.number(), .events = events, .revents = 0};
  while (::poll(&socket, 1, look_ms) <= 0) {
    check_();
    check_says_little(process_);
    if (Clock::now() > until) {
      throw core::InputError("its process has not answered for " + std::to_string(place_.patience.answer_seconds) + " s");
    }
  }
}

/// The other end is closed, so the process has ended, or will never answer.
void ForeignRun::fail() {
  for (const auto until = Clock::now() + std::chrono::seconds(place_.patience.answer_seconds); Clock::now() < until;) {
    if (const std::optional<int> status = process_.status()) {
      throw core::InputError(complaint_of(process_, *status));
    }
    check_();
    ::poll(nullptr, 0, 1);
  }
  throw core::InputError("its process does not answer any more");
}

}  // namespace dmpc::apps
