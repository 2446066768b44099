// Distances of a run's counted rays between nodes, on a machine with a given topology.
#pragma once

#include "dataflow/run.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// Mean number of links per ray message; 0 without messages. A node's position in the machine is its number.
struct RayHops {
  double mean = 0;            ///< with the regions as mapped
  double mean_of_random = 0;  ///< with the regions on random nodes, over a few draws
};

/// A ray that was sent by way of the host counts as if sent to its owner.
RayHops ray_hops_of(const dataflow::Report& report, nodes::TopologyKind topology);

}  // namespace dmpc::apps
