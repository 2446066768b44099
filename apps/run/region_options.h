// How space is cut into regions, in the words of the command line.
#pragma once

#include "apps/edge/line/command_line.h"
#include "dataflow/regions/balance.h"
#include "dataflow/regions/bsp.h"

namespace dmpc::apps {

/// As the command line calls it.
const char* name_of(dataflow::Balance balance);
/// As the command line calls it.
const char* name_of(dataflow::CutOrder order);
/// For OptionSet::check_in_the_end(), of all these options: throws core::UsageError for those that do not go with the balance.
void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance);

}  // namespace dmpc::apps
