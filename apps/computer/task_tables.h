// What each task of the last run took, as maps, tables and sentences.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/computer/record.h"
#include "apps/edge/show/page/number_map.h"
#include "apps/edge/table/table.h"

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

}  // namespace dmpc::apps::html
