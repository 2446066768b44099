// A thread that runs for short periods, but soon after it is woken.
#pragma once

#include <cstdint>
#include <optional>

namespace dmpc::nodes {

/// Sets what the calling thread, and those that it starts meanwhile, request from the scheduler while this lives: to be woken on
/// time (otherwise the kernel may be 50 us late), and to run for 0.1 ms at a time if others want the core, in return for running
/// before them (Linux 6.12 on; earlier ones keep their own slices). Their share of the processors stays the same. For ranks,
/// between whose nodes an answer takes up to six threads' turns, each of which would wait for milliseconds while others compute.
/// Thread safety: belongs to the thread that made it.
class Promptness {
 public:
  Promptness();
  ~Promptness();
  Promptness(const Promptness&) = delete;
  Promptness& operator=(const Promptness&) = delete;

 private:
  int timer_slack_ns_;
  std::optional<std::uint64_t> slice_ns_;  ///< the value before; nothing if the kernel does not report it
};

}  // namespace dmpc::nodes
