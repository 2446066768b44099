// What a program of tasks counted, as tables, maps and plots of them.
#pragma once

#include <string>
#include <vector>

#include "apps/computer/page_parts.h"
#include "apps/computer/paged_record.h"
#include "apps/edge/show/page/losses.h"
#include "apps/edge/show/page/number_map.h"
#include "apps/edge/show/page/traffic.h"
#include "apps/edge/show/page/view_tables.h"
#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"

namespace dmpc::apps::html {

// Of all runs together.

/// In virtual time by what a node waits for, else by the wall clock.
Losses losses_of(const PagedRecord& record);
std::vector<PacketKindTraffic> packets_of(const PagedRecord& record);
/// The program's, and on a modelled machine what pages take.
std::vector<OperationCount> operations_of(const PagedRecord& record);
/// A row for each node: its look-ups and what became of them, the operations of its tasks, and its memory.
Table node_table(const PagedRecord& record);
Plot fault_plot();

// Of the last run.

/// What is shown of a task's heat.
enum class TaskHeatKind : std::uint8_t { faults, references, computing };
/// The kinds that say something of this run: computing only on a modelled machine, faults only if there are any.
std::vector<TaskHeatKind> heat_kinds_of(const PagedRecord& record);
/// A row for each node, its tasks from left to right, as many together as it takes for each row to be full; each place is the
/// mean of its tasks, of a node without tasks 0.
NumberMap heat_map(const PagedRecord& record, TaskHeatKind kind);
/// The share of the hottest tasks.
std::string heat_conclusion(const PagedRecord& record, TaskHeatKind kind);
/// The tasks with the most computing or, on threads, look-ups.
Table hottest_tasks(const PagedRecord& record);

}  // namespace dmpc::apps::html
