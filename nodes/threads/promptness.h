// A thread that runs for short whiles, but soon after it is woken.
#pragma once

#include <cstdint>
#include <optional>

namespace dmpc::nodes {

/// What the calling thread, and those that it starts meanwhile, ask the scheduler for while this lives: to be woken on time (the
/// kernel may else be 50 us late), and to run for 0.1 ms at a time where others want the core, in return for running before them
/// (Linux 6.12 on; earlier ones leave it at their own). Their share of the processors stays what it is. For ranks, between whose
/// nodes an answer takes up to six threads' turns, each of which would wait for the milliseconds of whoever computes. Thread
/// safety: belongs to the thread that made it.
class Promptness {
 public:
  Promptness();
  ~Promptness();
  Promptness(const Promptness&) = delete;
  Promptness& operator=(const Promptness&) = delete;

 private:
  int timer_slack_ns_;
  std::optional<std::uint64_t> slice_ns_;  ///< as before; nothing if the kernel does not tell
};

}  // namespace dmpc::nodes
