#include "core/database/shading/choice_tree.h"

#include <algorithm>
#include <cstddef>

#include "core/base/expect.h"

namespace dmpc::core {

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
    const ChoiceNode& parent = tree[node == 0 ? 0 : (node - 1) / choice_children];
    const std::size_t its_child = node == 0 ? 0 : (node - 1) % choice_children;
    const double low = node == 0 ? 0.0 : parent.bound[its_child], high = node == 0 ? 1.0 : parent.bound[its_child + 1];
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
