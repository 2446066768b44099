// Times by what they went to, in steps of equal length that double as a run goes on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmpc::nodes {

/// `Times`: an array of nanoseconds by kind.
template <class Times>
struct StepSums {
  std::vector<Times> steps;  ///< up to the last that has anything

  /// Two steps become one.
  void join_pairs() {
    const std::size_t count = (steps.size() + 1) / 2;
    for (std::size_t i = 0; i < count; ++i) {
      Times sum = steps[2 * i];
      for (std::size_t kind = 0; 2 * i + 1 < steps.size() && kind < sum.size(); ++kind) {
        sum[kind] += steps[2 * i + 1][kind];
      }
      steps[i] = sum;
    }
    steps.resize(count);
  }

  /// `own_ns` spread over the time from begin to end, rounded so that nothing is lost.
  void add(std::size_t kind, std::uint64_t step_ns, std::uint64_t begin_ns, std::uint64_t end_ns, std::uint64_t own_ns) {
    const std::size_t last = end_ns > begin_ns ? (end_ns - 1) / step_ns : begin_ns / step_ns;
    steps.resize(std::max(steps.size(), last + 1));
    std::uint64_t given_ns = 0;
    for (std::size_t step = begin_ns / step_ns; step <= last; ++step) {
      const std::uint64_t until_ns = std::min(end_ns, (step + 1) * step_ns);
      const double share = step == last ? 1 : static_cast<double>(until_ns - begin_ns) / static_cast<double>(end_ns - begin_ns);
      const std::uint64_t due_ns = step == last ? own_ns : static_cast<std::uint64_t>(share * static_cast<double>(own_ns));
      steps[step].at(kind) += due_ns - given_ns;
      given_ns = due_ns;
    }
  }
};

}  // namespace dmpc::nodes
