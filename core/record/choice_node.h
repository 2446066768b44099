// The tree by which a hit selects one of many emitters, or tiles of a sky's picture, in proportion to their weights.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/units.h"

namespace dmpc::core {

/// A node's children.
inline constexpr std::uint32_t choice_children = 7;

/// A node of the tree: child i is selected by the numbers from bound[i] to bound[i + 1]. Numbers are of the whole tree, in [0,
/// 1). So a number inverts the cumulative distribution, and numbers that are evenly spread select each choice as often as its
/// weight says, to within one. An alias table would need a single look-up, but it scatters its numbers: with a sun among ten
/// thousand tiles of a sky, the picture then takes ten times the samples.
struct ChoiceNode {
  std::array<double, choice_children + 1> bound{};
};
static_assert(sizeof(ChoiceNode) == 64);

/// The nodes above this many choices; with one choice there are none. Nodes and then choices are numbered as in a heap: the
/// children of node n are choice_children * n + 1 and the following.
constexpr std::uint32_t choice_node_count(std::uint32_t choices) {
  return choices < 2 ? 0 : ceil_divide(choices - 1, choice_children - 1);
}

/// Where a node leads a number.
struct ChoiceStep {
  std::uint32_t child = 0;  ///< 0 to choice_children - 1
  double place = 0;         ///< in the child's interval, in [0, 1)
};
/// Children without numbers, which are the last, are never selected.
constexpr ChoiceStep step_of(const ChoiceNode& node, double number) {
  std::uint32_t child = 0;
  while (child + 1 < choice_children && number >= node.bound[child + 1] && node.bound[child + 1] < node.bound.back()) {
    ++child;
  }
  const double low = node.bound[child];
  return {child, (number - low) / (node.bound[child + 1] - low)};
}

}  // namespace dmpc::core
