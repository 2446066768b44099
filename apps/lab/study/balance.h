// The study `balance`: how evenly the work of rays that travel is shared out, and what it is worth where the regions lie.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"
#include "dataflow/regions/balance.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// For each node count the regions by the subsampled picture, cut across the longer side and in alternating directions, those of
/// equal size, one a node and scattered: the average load, predicted and achieved, copies of primitives, and hops of a ray from
/// node to node.
struct BalanceStudy {
  static constexpr const char* name = "balance";
  static constexpr const char* description = "How evenly the work of rays that travel is shared out";

  std::vector<std::uint32_t> node_counts = {4, 8, 16, 32, 64};
  dataflow::BalanceOptions regions;  ///< how loads are predicted; which way they are cut is without meaning
  nodes::TopologyKind topology = nodes::TopologyKind::hypercube;
  bool per_node = false;  ///< below each row one more for each node, with its share of the work

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

}  // namespace dmpc::apps
