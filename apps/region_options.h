// The options that say how space is cut into regions and where these are put.
#pragma once

#include "apps/command_line.h"
#include "dataflow/balance.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// Declares --subsample, --balance-grid and --topology, but not which balance there is.
void add_region_options(OptionSet options, dataflow::BalanceOptions& balance, nodes::TopologyKind& topology);

}  // namespace dmpc::apps
