// The figures that our speed is to reach.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/comparison.h"

namespace dmpc::apps {

/// A figure over some comparisons: their geometric mean, or the worst of them.
struct Target {
  std::string name;
  double reach = 1, goal = 1;  ///< what is to be reached, and the goal beyond it
  bool is_more_better = false;
  bool is_worst = false;  ///< every comparison is to reach it
  std::function<bool(const Comparison&)> counts;
};

/// All of them, in the order of the parts.
const std::vector<Target>& speed_targets();

/// What the measured ones of the comparisons that count come to; nothing if there are none.
std::optional<double> figure_of(const Target& target, std::span<const Comparison> comparisons);

/// "kernel ...: 0.61; to reach 0.75 (missed), goal 1.00." Nothing as figure_of().
std::optional<std::string> sentence_on(const Target& target, std::span<const Comparison> comparisons);

}  // namespace dmpc::apps
