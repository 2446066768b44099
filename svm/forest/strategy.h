// The strategy by which questions travel: J. Goldsmith and J. Salmon's, over one tree of boxes.
#pragma once

#include "svm/strategy.h"

namespace dmpc::svm {

/// Every node holds the upper part of the tree, and asks the owners of its subtrees what rays meet there.
const Strategy* forest_strategy();

}  // namespace dmpc::svm
