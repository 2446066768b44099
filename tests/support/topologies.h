// All topologies.
#pragma once

#include <array>

#include "nodes/topology.h"

namespace dmpc::tests {

using nodes::TopologyKind;
inline constexpr std::array all_topologies{TopologyKind::crossbar, TopologyKind::hypercube, TopologyKind::mesh,
                                           TopologyKind::torus, TopologyKind::fat_tree};

}  // namespace dmpc::tests
