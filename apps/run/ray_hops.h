// How far the counted rays of a run went from node to node, on a machine with a given wiring.
#pragma once

#include "dataflow/run.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// Links that a ray message passes, on average; 0 without messages. A node's place in the machine is its number.
struct RayHops {
  double mean = 0;            ///< as the regions were mapped
  double mean_of_random = 0;  ///< with the regions on random nodes, over some draws
};

/// A ray that went by way of the host counts as if sent to its owner.
RayHops ray_hops_of(const dataflow::Report& report, nodes::TopologyKind topology);

}  // namespace dmpc::apps
