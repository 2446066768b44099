// The idle strategy of a node: polls before sleep.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dmpc::nodes {

/// The number of polls of an empty mailbox, with a sched_yield before each, before one of `thread_count` threads sleeps. If
/// several share a core, a yield that lets another one run costs less than a sleep and a wake-up, which take some microseconds
/// (tens across cores); more polls gain nothing. If hardly two share one, none of ours waits for the core, and on a machine that
/// others use a yield gives it away for milliseconds, while a sleeper gets it back soon after it is woken. `core_count` 0: not
/// known.
constexpr int polls_before_sleep(std::size_t thread_count, std::size_t core_count) {
  constexpr int polls = 4;
  return thread_count > 2 * core_count + 1 ? polls : 0;
}

/// One node's polls: polls_before_sleep(), unless its yields are found to give the core to other processes, as they then would
/// repeatedly. A yield that takes longer than a hundred sleeps has let some thread run for long: another process's, if this
/// process has had less than 0.4 of the machine's processors since the last such yield. Then the node sleeps at once for a while.
/// Beside ten processes that compute without end on two cores svm on 64 nodes takes a quarter of the time with this (teapot-12,
/// 512x512); with more than half of the processors, yields that find our own nodes cost less than sleeps.
class PollBackoff {
 public:
  constexpr PollBackoff(int most, std::size_t core_count) : most_(most), core_count_(core_count) {}

  static constexpr double least_share = 0.4;
  static constexpr std::uint64_t long_yield_ns = 1'000'000;
  static constexpr std::uint32_t sleeps_at_once_max = 256;

  /// The number of polls that the node may make now.
  constexpr int allowed() const { return sleeps_at_once_ > 0 ? 0 : most_; }
  /// To be called after a long yield; `now_ns` is the monotonic clock, `processor_ns` the process's time so far.
  constexpr void yielded_long(std::uint64_t now_ns, std::uint64_t processor_ns) {
    const double all = static_cast<double>(now_ns - last_ns_) * static_cast<double>(core_count_);
    const bool others_run = last_ns_ > 0 && static_cast<double>(processor_ns - last_processor_ns_) < least_share * all;
    sleeps_at_once_ = others_run ? sleeps_at_once_max : sleeps_at_once_;
    last_ns_ = now_ns;
    last_processor_ns_ = processor_ns;
  }
  /// To be called after the polls: the node sleeps now if nothing has arrived.
  constexpr void end() { sleeps_at_once_ -= sleeps_at_once_ > 0 ? 1 : 0; }

 private:
  int most_;
  std::size_t core_count_;
  std::uint32_t sleeps_at_once_ = 0;  ///< that are left
  std::uint64_t last_ns_ = 0, last_processor_ns_ = 0;
};

}  // namespace dmpc::nodes
