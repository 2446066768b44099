// How much of what came when, by number: rows of steps of equal length that double as a run goes on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::nodes {

/// Not thread-safe.
class StepCounts {
 public:
  /// `step_count_max`, which is even, steps of at most `row_max` numbers below `number_count`.
  StepCounts(std::uint32_t number_count, std::size_t row_max, std::size_t step_count_max);

  /// Adds to the step in which `time_ns` is, or raises it.
  void add(std::uint32_t number, std::uint64_t time_ns, std::uint64_t amount) { at(number, time_ns) += amount; }
  void raise(std::uint32_t number, std::uint64_t time_ns, std::uint64_t amount);

  std::uint64_t step_ns() const { return step_ns_; }
  std::size_t step_count_max() const { return step_count_max_; }
  /// False where there were more numbers than rows: then those of the last are not here.
  bool is_complete() const { return is_complete_; }
  /// Of all steps; empty of a number that never came.
  std::span<const std::uint64_t> row(std::uint32_t number) const;

 private:
  std::uint64_t& at(std::uint32_t number, std::uint64_t time_ns);
  void join_pairs();

  std::size_t row_max_, step_count_max_;
  std::uint64_t step_ns_ = 1024;
  bool is_complete_ = true;
  bool raises_ = false;                ///< two steps become the larger, not the sum
  std::vector<std::uint32_t> row_of_;  ///< by number, from 1 on; 0: none
  std::vector<std::uint64_t> counts_;  ///< row by row, the first for what has none
};

}  // namespace dmpc::nodes
