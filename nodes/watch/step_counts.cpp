#include "nodes/watch/step_counts.h"

#include <algorithm>

#include "core/base/expect.h"

namespace dmpc::nodes {

StepCounts::StepCounts(std::uint32_t number_count, std::size_t row_max, std::size_t step_count_max)
    : row_max_(row_max), step_count_max_(step_count_max), row_of_(number_count), counts_(step_count_max) {
  core::expect(step_count_max >= 2 && step_count_max % 2 == 0, "steps can be joined in pairs");
}

std::uint64_t& StepCounts::at(std::uint32_t number, std::uint64_t time_ns) {
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

void StepCounts::raise(std::uint32_t number, std::uint64_t time_ns, std::uint64_t amount) {
  raises_ = true;
  std::uint64_t& most = at(number, time_ns);
  most = std::max(most, amount);
}

void StepCounts::join_pairs() {
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

std::span<const std::uint64_t> StepCounts::row(std::uint32_t number) const {
  const std::uint32_t row = row_of_.at(number);
  return row == 0 ? std::span<const std::uint64_t>() : std::span(counts_.data() + row * step_count_max_, step_count_max_);
}

}  // namespace dmpc::nodes
