#include "nodes/threads/promptness.h"

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dmpc::nodes {
namespace {

constexpr std::uint64_t prompt_slice_ns = 100'000;
constexpr unsigned long prompt_timer_slack_ns = 1;

/// The kernel's struct sched_attr, first version (sched_setattr(2)): the C library has no name for it, and the kernel's header
/// conflicts with the C library's.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime_ns = 0;  ///< for an ordinary thread: its slice
  std::uint64_t deadline_ns = 0, period_ns = 0;
};
static_assert(sizeof(SchedulingAttributes) == 48);

std::optional<SchedulingAttributes> attributes() {
  SchedulingAttributes found;
  return ::syscall(SYS_sched_getattr, 0, &found, sizeof(found), 0) == 0 ? std::optional(found) : std::nullopt;
}

/// Sets the slice of the calling thread and returns the old one. A refusal leaves it unchanged, which only costs time.
std::optional<std::uint64_t> set_slice(std::uint64_t slice_ns) {
  std::optional<SchedulingAttributes> wanted = attributes();
  if (!wanted) {
    return std::nullopt;
  }
  const std::uint64_t before_ns = wanted->runtime_ns;
  wanted->runtime_ns = slice_ns;
  ::syscall(SYS_sched_setattr, 0, &*wanted, 0);
  return before_ns;
}

}  // namespace

Promptness::Promptness() : timer_slack_ns_(::prctl(PR_GET_TIMERSLACK)), slice_ns_(set_slice(prompt_slice_ns)) {
  ::prctl(PR_SET_TIMERSLACK, prompt_timer_slack_ns);
}

Promptness::~Promptness() {
  ::prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(timer_slack_ns_));
  if (slice_ns_) {
    set_slice(*slice_ns_);
  }
}

}  // namespace dmpc::nodes
