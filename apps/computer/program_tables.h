// Tables and plots of a program's counters; for a program of tasks summed over all runs.
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

/// Quantities of a task's heat map.
enum class TaskHeatKind : std::uint8_t { faults, references, computing };
/// Returns the kinds that are informative for this run: computing only on a modelled machine, faults only if there are any.
std::vector<TaskHeatKind> heat_kinds_of(const ProgramRecord& record);
/// Returns a row per node with its tasks from left to right, grouped so that each row is full. Each cell is the mean of its
/// tasks; a node without tasks has 0.
NumberMap heat_map(const ProgramRecord& record, TaskHeatKind kind);
/// Describes the share of the hottest tasks.
std::string heat_conclusion(const ProgramRecord& record, TaskHeatKind kind);
/// Returns the tasks with the most computing or, on threads, the most look-ups.
Table hottest_tasks(const ProgramRecord& record);

/// In virtual time by what a node waits for, else by the wall clock.
Losses losses_of(const ProgramRecord& record);

/// Returns what all nodes together sent, in the order of the vocabulary.
std::vector<PacketKindTraffic> packets_of(const ProgramRecord& record);

/// Returns the program's operations in the same order, and on a modelled machine those of pages.
std::vector<OperationCount> operations_of(const ProgramRecord& record);

/// Returns a row per node: its traffic, or its look-ups with their outcomes and its memory; and its charged operations.
Table node_table(const ProgramRecord& record);
/// Returns a bar per node: packets, or requested pages.
Plot node_plot(const ProgramRecord& record);
/// Returns one sentence on a program with packets.
std::string node_conclusion(const ProgramRecord& record);

/// Returns a row per node: declared and allocated memory of its program, and memory for its packets.
Table memory_table(const ProgramRecord& record);
Plot memory_plot(const ProgramRecord& record);
std::string memory_conclusion(const ProgramRecord& record);

}  // namespace dmpc::apps::html
