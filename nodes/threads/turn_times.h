// The share of each of the nodes on a worker thread in that thread's processor time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nodes/counters.h"

namespace dmpc::nodes {

/// Turns follow each other without a gap. The wall clock, which is cheap to read, is read after each; the clock of the thread's
/// processor time, which costs a system call, after a long one or many short ones. Short turns are measured by the wall clock, as
/// in them a thread hardly waits for its core; the last one gets the rest of the thread's time since that clock was read last.
/// Not thread-safe; belongs to the thread.
class TurnTimes {
 public:
  /// The maximum number of turns that are accounted together.
  static constexpr std::size_t turns_max = 64;
  static constexpr std::uint64_t long_turn_ns = 50'000;

  /// Begins the first turn, or one after a sleep. Expects that turns before that are accounted.
  void begin(std::uint64_t wall_ns, std::uint64_t processor_ns) {
    now_ns_ = wall_ns;
    processor_ns_ = processor_ns;
  }
  /// The end of the last turn, or the time of begin().
  std::uint64_t now_ns() const { return now_ns_; }

  /// Ends a turn of the node with these counters, which outlive this. True if share_out() is due before another turn.
  [[nodiscard]] bool end_turn(NodeCounters& counters, std::uint64_t wall_ns) {
    const std::uint64_t length_ns = wall_ns - now_ns_;
    turns_[count_++] = {&counters, length_ns};
    now_ns_ = wall_ns;
    return count_ == turns_max || length_ns >= long_turn_ns;
  }

  /// Adds the thread's time since then to `busy_ns` of the nodes that had the turns.
  void share_out(std::uint64_t processor_ns) {
    if (count_ == 0) {
      return;
    }
    const std::uint64_t had_ns = processor_ns - processor_ns_;
    std::uint64_t before_last_ns = 0;
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      before_last_ns += turns_[i].length_ns;
    }
    const double share = before_last_ns <= had_ns ? 1.0 : static_cast<double>(had_ns) / static_cast<double>(before_last_ns);
    std::uint64_t left_ns = had_ns;
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      const auto part_ns = static_cast<std::uint64_t>(static_cast<double>(turns_[i].length_ns) * share);
      turns_[i].counters->busy_ns += part_ns;
      left_ns -= part_ns;
    }
    turns_[count_ - 1].counters->busy_ns += left_ns;
    processor_ns_ = processor_ns;
    count_ = 0;
  }

 private:
  struct Turn {
    NodeCounters* counters = nullptr;
    std::uint64_t length_ns = 0;
  };

  std::array<Turn, turns_max> turns_;
  std::size_t count_ = 0;
  std::uint64_t now_ns_ = 0, processor_ns_ = 0;
};

}  // namespace dmpc::nodes
