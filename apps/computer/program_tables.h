// What a program with packets counted, as tables, and plots of them.
#pragma once

#include <string>
#include <vector>

#include "apps/computer/page_parts.h"
#include "apps/computer/record.h"
#include "apps/edge/show/page/losses.h"
#include "apps/edge/show/page/traffic.h"
#include "apps/edge/show/page/view_tables.h"
#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"

namespace dmpc::apps::html {

/// In virtual time by what a node waits for, else by the wall clock.
Losses losses_of(const ProgramRecord& record);

/// Of all nodes together, as the program declares them.
std::vector<PacketKindTraffic> packets_of(const ProgramRecord& record);

/// Of all nodes together, in the same order.
std::vector<OperationCount> operations_of(const ProgramRecord& record);

/// A row for each node: what passed through it, and the operations that it was charged.
Table node_table(const ProgramRecord& record);
Plot packet_plot();
std::string node_conclusion(const ProgramRecord& record);

/// A row for each node: what its program has allocated of what it declared, and what carries its packets.
Table memory_table(const ProgramRecord& record);
Plot memory_plot(const ProgramRecord& record);
std::string memory_conclusion(const ProgramRecord& record);

}  // namespace dmpc::apps::html
