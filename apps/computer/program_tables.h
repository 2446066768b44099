// What a program counted, as tables, and plots of them; of one of tasks in all its runs together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/computer/page_parts.h"
#include "apps/computer/record.h"
#include "apps/frontend/show/page/losses.h"
#include "apps/frontend/show/page/number_map.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/show/page/view_tables.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// What is shown of a task's heat.
enum class TaskHeatKind : std::uint8_t { faults, references, computing };
/// The kinds that say something of this run: computing only on a modelled machine, faults only if there are any.
std::vector<TaskHeatKind> heat_kinds_of(const ProgramRecord& record);
/// A row for each node, its tasks from left to right, as many together as it takes for each row to be full; each place is the
/// mean of its tasks, of a node without tasks 0.
NumberMap heat_map(const ProgramRecord& record, TaskHeatKind kind);
/// The share of the hottest tasks.
std::string heat_conclusion(const ProgramRecord& record, TaskHeatKind kind);
/// The tasks with the most computing or, on threads, look-ups.
Table hottest_tasks(const ProgramRecord& record);

/// In virtual time by what a node waits for, else by the wall clock.
Losses losses_of(const ProgramRecord& record);

/// What all nodes together sent, in the order of the vocabulary.
std::vector<PacketKindTraffic> packets_of(const ProgramRecord& record);

/// The program's, in the same order, and on a modelled machine what pages take.
std::vector<OperationCount> operations_of(const ProgramRecord& record);

/// A row for each node: what passed through it, or its look-ups, what became of them and its memory; and the operations that it
/// was charged.
Table node_table(const ProgramRecord& record);
/// A bar for each node: packets, or pages that it asked for.
Plot node_plot(const ProgramRecord& record);
/// One sentence on a program with packets.
std::string node_conclusion(const ProgramRecord& record);

/// A row for each node: what its program has allocated of what it declared, and what carries its packets.
Table memory_table(const ProgramRecord& record);
Plot memory_plot(const ProgramRecord& record);
std::string memory_conclusion(const ProgramRecord& record);

}  // namespace dmpc::apps::html
