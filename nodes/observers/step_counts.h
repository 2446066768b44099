// Counts by number over time: rows of steps of equal length that doubles as a run goes on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// Not thread-safe.
class StepCounts {
 public:
  /// `step_count_max`, which is even, steps of at most `row_max` numbers below `number_count`.
  StepCounts(std::uint32_t number_count, std::size_t row_max, std::size_t step_count_max)
      : row_max_(row_max), step_count_max_(step_count_max), row_of_(number_count), counts_(step_count_max) {
    core::expect(step_count_max >= 2 && step_count_max % 2 == 0, "steps can be joined in pairs");
  }

  /// Adds to the step of `time_ns`, or raises it.
  void add(std::uint32_t number, std::uint64_t time_ns, std::uint64_t amount) { at(number, time_ns) += amount; }
  void raise(std::uint32_t number, std::uint64_t time_ns, std::uint64_t amount) {
    raises_ = true;
    std::uint64_t& most = at(number, time_ns);
    most = std::max(most, amount);
  }

  std::uint64_t step_ns() const { return step_ns_; }
  std::size_t step_count_max() const { return step_count_max_; }
  /// False if there were more numbers than rows: then the last numbers are missing.
  bool is_complete() const { return is_complete_; }
  /// All steps; empty for a number that never occurred.
  std::span<const std::uint64_t> row(std::uint32_t number) const {
    const std::uint32_t row = row_of_.at(number);
    return row == 0 ? std::span<const std::uint64_t>() : std::span(counts_.data() + row * step_count_max_, step_count_max_);
  }

 private:
  std::uint64_t& at(std::uint32_t number, std::uint64_t time_ns) {
    while (time_ns >= step_ns_ * step_count_max_) {
      join_pairs();
    }
    std::uint32_t& row = row_of_.at(number);
    if (row == 0) {
      if (counts_.size() / step_count_max_ > row_max_) {
        is_complete_ = false;
      } else {
        row = static_cast<std::uint32_t>(counts_.size() / step_count_max_);
        counts_.resize(counts_.size() + step_count_max_);
      }
    }
    return counts_[row * step_count_max_ + time_ns / step_ns_];
  }

  void join_pairs() {
    for (std::size_t row = 0; row < counts_.size(); row += step_count_max_) {
      const std::span<std::uint64_t> steps(counts_.data() + row, step_count_max_);
      for (std::size_t i = 0; i < step_count_max_ / 2; ++i) {
        const std::uint64_t first = steps[2 * i], second = steps[2 * i + 1];
        steps[i] = raises_ ? std::max(first, second) : first + second;
      }
      std::fill(steps.begin() + static_cast<std::ptrdiff_t>(step_count_max_ / 2), steps.end(), 0);
    }
    step_ns_ *= 2;
  }

  std::size_t row_max_, step_count_max_;
  std::uint64_t step_ns_ = 1024;
  bool is_complete_ = true;
  bool raises_ = false;                ///< two steps become the larger, not the sum
  std::vector<std::uint32_t> row_of_;  ///< by number, from 1 on; 0: none
  std::vector<std::uint64_t> counts_;  ///< row by row, the first for numbers without one
};

}  // namespace dmpc::nodes
