// The report of a run, independent of its strategy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "apps/frontend/run/time_parts.h"
#include "apps/run/strategy_options.h"
#include "core/picture/film/film.h"
#include "core/trace/operations.h"
#include "dataflow/run.h"
#include "nodes/counters.h"
#include "nodes/ranks/rank_figures.h"
#include "svm/run.h"

namespace dmpc::apps {

/// svm and replicated have the same report.
using Report = std::variant<svm::Report, dataflow::Report>;

/// Returns the names of the waits for a strategy's packets.
WaitKinds wait_kinds(Strategy strategy);

/// The part of a node's report that all strategies share. A view.
struct NodeAccount {
  const core::Operations& operations;
  const nodes::NodeCounters& counters;
  const nodes::MemoryPlan& memory_planned;
  const nodes::MemoryPlan& memory_used;
};

/// The part of a run's report that all strategies share. A view: the report outlives it.
struct Account {
  const core::Film& film;
  nodes::RunEnd end;
  std::size_t node_memory_max_bytes;                        ///< maximum over the nodes
  const std::optional<nodes::Chaos>& chaos;                 ///< the disturbance of the run
  std::vector<NodeAccount> nodes;                           ///< by number
  core::Operations operations;                              ///< sum over the nodes
  const nodes::NodeCounters& host;                          ///< the host's
  std::uint64_t host_deposits_saturated;                    ///< pixels whose sums saturated on the host's film
  nodes::TrafficByKind sent;                                ///< by all nodes and the host, by packet kind
  std::span<const char* const> kind_names;                  ///< names of the strategy's packet kinds
  const std::optional<nodes::VirtualReport>& virtual_time;  ///< modelled machine only
  WaitKinds waits;                                          ///< names of the waits for these packets
  core::RefinementResult refinement;
  const std::vector<nodes::RankFigures>& ranks;  ///< if there are or could be several
};

/// Thread-safe, as long as the report is not changed.
Account account_of(const Report& report);

/// Leaves the film and what was planned, and sets what the run has counted to 0; there is no virtual time. For a picture that is
/// written once more without a run.
void clear_counters(Report& report);

/// Returns the total time of all nodes by parts, on a modelled machine.
TimeParts parts_of(const Account& account);

}  // namespace dmpc::apps
