// The options that say how space is cut into regions and where these are put.
#pragma once

#include "apps/command_line.h"
#include "dataflow/balance.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// Declares --subsample and --balance-grid, but not which balance there is.
void add_region_options(OptionSet options, dataflow::BalanceOptions& balance);
/// Declares --topology.
void add_topology_option(OptionSet options, nodes::TopologyKind& topology);

}  // namespace dmpc::apps
