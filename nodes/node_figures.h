// What every node reports when a run is over, whatever its program.
#pragma once

#include <type_traits>

#include "nodes/counters.h"
#include "nodes/local_memory.h"
#include "nodes/node.h"

namespace dmpc::nodes {

/// A value.
struct NodeFigures {
  NodeCounters counters;
  MemoryPlan memory_planned, memory_used;
};
static_assert(std::is_trivially_copyable_v<NodeFigures>, "it travels as bytes to the host's rank");

/// After the run.
inline NodeFigures figures_of(Node& node) { return {node.counters(), node.memory().plan(), node.memory().used()}; }

}  // namespace dmpc::nodes
