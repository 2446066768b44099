// Gathers the reports of nodes and ranks after a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "nodes/counters.h"
#include "nodes/flat_bytes.h"
#include "nodes/local_memory.h"
#include "nodes/node.h"
#include "nodes/observers/watching.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// A node's report after a run of any program. A value.
struct NodeFigures {
  NodeCounters counters;
  MemoryPlan memory_planned, memory_used;
};
static_assert(std::is_trivially_copyable_v<NodeFigures>, "it travels as bytes to the host's rank");

/// After the run.
inline NodeFigures figures_of(Node& node) { return {node.counters(), node.memory().plan(), node.memory().used()}; }

/// To be called on all ranks. tell(index, flat) writes the report of the program of a node that is here; take(index, flat) reads
/// it, in the same order: of all nodes, by number, on the host's rank; elsewhere of those that are there.
template <class Report, class Take>
void gather_nodes(Runner& runner, std::uint32_t node_count, const Report& report, const Take& take) {
  const std::vector<std::string> reported = runner.gather([&](std::size_t index) {
    FlatWriter flat;
    if (index < node_count) {
      report(index, flat);
    }
    return flat.take();
  });
  for (std::uint32_t index = 0; index < node_count; ++index) {
    if (!reported[index].empty()) {
      FlatReader flat(reported[index]);
      take(index, flat);
    }
  }
}

/// As gather_nodes(), for ranks, to be called after it: returns what is known of each rank; nothing without ranks. `planned`:
/// argument of peers_of(). seen(), if given, returns what was observed here; on the host's rank, add(seen, clock) takes what was
/// observed on each other rank.
template <class Planned>
std::vector<RankFigures> gather_rank_figures(Runner& runner, const Planned& planned, const RankLinks* links, const AddSeen& add,
                                             const std::function<std::string()>& seen = {}) {
  if (links == nullptr) {
    return {};
  }
  const std::vector<RankReport> reported = runner.gather_ranks(seen ? seen() : std::string());
  for (std::size_t rank = 1; add && rank < reported.size(); ++rank) {
    add(reported[rank].reported, reported[rank].clock);
  }
  return rank_figures(peers_of(planned), *links, reported);
}

}  // namespace dmpc::nodes
