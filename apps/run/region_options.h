// The options that say how space is cut into regions and where these are put.
#pragma once

#include "apps/edge/line/command_line.h"
#include "dataflow/regions/balance.h"
#include "dataflow/regions/bsp.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// As the command line calls it.
const char* name_of(dataflow::Balance balance);
/// Declares --balance.
void add_balance_option(OptionSet options, dataflow::Balance& balance);
/// As the command line calls it.
const char* name_of(dataflow::CutOrder order);
/// Declares --cuts.
void add_cuts_option(OptionSet options, dataflow::CutOrder& order);
/// Declares --regions.
void add_scattered_option(OptionSet options, dataflow::BalanceOptions& balance);
/// Declares --subsample and --balance-grid, but not which balance there is.
void add_region_options(OptionSet options, dataflow::BalanceOptions& balance);
/// For OptionSet::check_in_the_end(), of all these options: throws core::UsageError for those that do not go with the balance.
void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance);
/// Declares --topology.
void add_topology_option(OptionSet options, nodes::TopologyKind& topology);

}  // namespace dmpc::apps
