// Makes the tree that selects one of many in proportion to weights.
#pragma once

#include <span>
#include <vector>

#include "core/record/choice_node.h"

namespace dmpc::core {

/// The nodes for these weights, one or more, each above 0 and their sum finite; none for one.
std::vector<ChoiceNode> choice_tree(std::span<const double> weights);

}  // namespace dmpc::core
