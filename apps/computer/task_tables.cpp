#include "apps/computer/task_tables.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/shares.h"

namespace dmpc::apps::html {
namespace {

constexpr std::size_t tasks_listed = 20;
/// A map of heat has as many columns for a node's tasks, at most.
constexpr std::size_t heat_columns_max = 128;

const nodes::Machine* machine_of(const ProgramRecord& record) { return record.options.computer.model(); }

/// Counts, or nanoseconds of computing.
double heat_of(const nodes::Machine* machine, const svm::TaskTaken& taken, TaskHeatKind kind) {
  switch (kind) {
    case TaskHeatKind::faults:
      return static_cast<double>(taken.faults);
    case TaskHeatKind::references:
      return static_cast<double>(taken.references);
    case TaskHeatKind::computing:
      return machine == nullptr ? 0 : static_cast<double>(machine->price_ps(taken.charges)) / 1000;
  }
  return 0;
}

std::string words_of(TaskHeatKind kind) {
  return kind == TaskHeatKind::faults ? "faults" : kind == TaskHeatKind::references ? "look-ups" : "computing";
}

TaskHeatKind main_kind(const ProgramRecord& record) {
  return machine_of(record) != nullptr ? TaskHeatKind::computing : TaskHeatKind::references;
}

std::vector<double> heat_by_task(const ProgramRecord& record, TaskHeatKind kind) {
  std::vector<double> heat;
  for (const svm::TaskTaken& taken : record.tasks.heat) {
    heat.push_back(heat_of(machine_of(record), taken, kind));
  }
  return heat;
}

/// Cuts the tasks that one node has in a row into `columns` parts as equal as can be, and appends the mean of each.
void append_means(std::vector<double>& means, std::span<const double> tasks, std::size_t columns) {
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = tasks.size() * column / columns, end = tasks.size() * (column + 1) / columns;
    const std::span<const double> part = tasks.subspan(first, end - first);
    means.push_back(part.empty() ? 0 : sum_of(part) / static_cast<double>(part.size()));
  }
}

}  // namespace

std::vector<TaskHeatKind> heat_kinds_of(const ProgramRecord& record) {
  std::vector<TaskHeatKind> kinds;
  for (const TaskHeatKind kind : {TaskHeatKind::faults, TaskHeatKind::references, TaskHeatKind::computing}) {
    const bool is_known = kind != TaskHeatKind::computing || machine_of(record) != nullptr;
    if (is_known && sum_of(heat_by_task(record, kind)) > 0) {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

NumberMap heat_map(const ProgramRecord& record, TaskHeatKind kind) {
  const std::vector<double> heat = heat_by_task(record, kind);
  const std::size_t rows = record.nodes.size(), columns = std::clamp(heat.size() / rows, std::size_t{1}, heat_columns_max);
  const std::string parts = columns * rows < heat.size() ? ", in " + counted(columns, "part") : "";
  NumberMap map{.title = "The " + words_of(kind) + " of each task",
                .row_label = "node",
                .column_label = "its tasks in order" + parts,
                .value_label = words_of(kind),
                .unit = kind == TaskHeatKind::computing ? "ns" : "",
                .rows = rows,
                .columns = columns};
  std::size_t first = 0;
  for (std::uint32_t node = 0; node < rows; ++node) {
    std::size_t end = first;
    while (end < heat.size() && record.tasks.heat[end].node == node) {
      ++end;
    }
    append_means(map.values, std::span(heat).subspan(first, end - first), columns);
    first = end;
  }
  return map;
}

std::string heat_conclusion(const ProgramRecord& record, TaskHeatKind kind) {
  return "The tenth of the tasks with the most " + words_of(kind) + " had " +
         share_text(top_tenth_share(heat_by_task(record, kind))) + " of all.";
}

Table hottest_tasks(const ProgramRecord& record) {
  const TaskHeatKind kind = main_kind(record);
  std::vector<Column> columns = {{"task", "", 0}, {"node", "", 0}, {"steps", "", 0}, {"look-ups", "", 0}, {"faults", "", 0}};
  if (kind == TaskHeatKind::computing) {
    columns.push_back({"computing", "us", 3});
  }
  Table table("The tasks with the most " + words_of(kind), std::move(columns));
  const std::vector<double> heat = heat_by_task(record, kind);
  std::vector<std::size_t> tasks(heat.size());
  std::iota(tasks.begin(), tasks.end(), std::size_t{0});
  std::stable_sort(tasks.begin(), tasks.end(), [&](std::size_t a, std::size_t b) { return heat[a] > heat[b]; });
  tasks.resize(std::min(tasks.size(), tasks_listed));
  for (const std::size_t task : tasks) {
    const svm::TaskTaken& taken = record.tasks.heat[task];
    std::vector<Cell> row = {std::uint64_t{task}, std::uint64_t{taken.node}, taken.steps, taken.references, taken.faults};
    if (kind == TaskHeatKind::computing) {
      row.emplace_back(heat[task] / 1000);
    }
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace dmpc::apps::html
