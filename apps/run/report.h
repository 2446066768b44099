// What a run reports, whichever strategy it followed.
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

/// svm and replicated report alike.
using Report = std::variant<svm::Report, dataflow::Report>;

/// Kinds of waits by a strategy's packets.
WaitKinds wait_kinds(Strategy strategy);

/// What every strategy says of a node. A view.
struct NodeAccount {
  const core::Operations& operations;
  const nodes::NodeCounters& counters;
  const nodes::MemoryPlan& memory_planned;
  const nodes::MemoryPlan& memory_used;
};

/// What every strategy reports. A view: the report outlives it.
struct Account {
  const core::Film& film;
  nodes::RunEnd end;
  std::size_t node_memory_max_bytes;                        ///< what the fullest node takes
  const std::optional<nodes::Chaos>& chaos;                 ///< that disturbed the run
  std::vector<NodeAccount> nodes;                           ///< by number
  core::Operations operations;                              ///< summed over them
  const nodes::NodeCounters& host;                          ///< the host's
  std::uint64_t host_deposits_saturated;                    ///< pixels whose sums saturated on the host's film
  nodes::TrafficByKind sent;                                ///< by all nodes and the host, by kind
  std::span<const char* const> kind_names;                  ///< kinds of the strategy's packets
  const std::optional<nodes::VirtualReport>& virtual_time;  ///< modelled machine only
  WaitKinds waits;                                          ///< what the waits for these packets are
  core::RefinementResult refinement;
  const std::vector<nodes::RankFigures>& ranks;  ///< where there are several, or could be
};

/// Thread-safe, as long as nobody changes the report.
Account account_of(const Report& report);

/// What became of the nodes' time, all of them together, on a modelled machine.
TimeParts parts_of(const Account& account);

}  // namespace dmpc::apps
