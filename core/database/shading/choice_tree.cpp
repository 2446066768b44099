#include "core/database/shading/choice_tree.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::core {
namespace {

/// The numbers that lead to the node or choice behind this many below the root.
std::pair<double, double> interval_of(std::size_t below, std::span<const ChoiceNode> tree) {
  const ChoiceNode& parent = tree[below / choice_children];
  const std::size_t child = below % choice_children;
  return {parent.bound[child], parent.bound[child + 1]};
}

}  // namespace

std::vector<ChoiceNode> choice_tree(std::span<const double> weights) {
  const std::size_t nodes = choice_node_count(static_cast<std::uint32_t>(weights.size()));
  std::vector<double> sum(nodes);  // of all choices below the node, then each choice's own
  sum.insert(sum.end(), weights.begin(), weights.end());
  for (std::size_t i = sum.size() - 1; i > 0; --i) {
    sum[(i - 1) / choice_children] += sum[i];
  }
  expect(sum[0] > 0.0 && sum[0] <= 1e300, "there is something to be selected");
  std::vector<ChoiceNode> tree(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto [low, high] = node == 0 ? std::pair(0.0, 1.0) : interval_of(node - 1, tree);
    double before = 0;
    for (std::size_t child = 0; child < choice_children; ++child) {
      const std::size_t index = node * choice_children + 1 + child;
      tree[node].bound[child] = index < sum.size() ? std::min(low + (high - low) * (before / sum[node]), high) : high;
      before += index < sum.size() ? sum[index] : 0.0;
    }
    tree[node].bound.back() = high;
  }
  return tree;
}

}  // namespace dmpc::core
