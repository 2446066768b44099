// Distances that rays travel between nodes, in a given topology.
#pragma once

#include "dataflow/run.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// Mean number of links per ray message; 0 without messages. A node's position in the topology is its number.
struct RayHops {
  double mean = 0;            ///< with the regions as mapped
  double mean_of_random = 0;  ///< mean over a few random mappings of the regions
};

/// Rays sent by way of the host count as if sent directly to their owner.
RayHops ray_hops_of(const dataflow::Report& report, nodes::TopologyKind topology);

}  // namespace dmpc::apps
