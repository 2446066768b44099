#include "apps/computer/paged_tables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/computer/own_name.h"
#include "apps/computer/task_heat_file.h"
#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/shares.h"
#include "svm/pages/packets.h"

namespace dmpc::apps::html {
namespace {

constexpr std::size_t tasks_listed = 20;
/// Of a node's tasks, in a map.
constexpr std::size_t heat_columns_max = 128;

const nodes::Machine* machine_of(const PagedRecord& record) { return record.options.program.computer.model(); }

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

TaskHeatKind main_kind(const PagedRecord& record) {
  return machine_of(record) != nullptr ? TaskHeatKind::computing : TaskHeatKind::references;
}

std::vector<double> heat_by_task(const PagedRecord& record, TaskHeatKind kind) {
  std::vector<double> heat;
  for (const svm::TaskTaken& taken : record.heat) {
    heat.push_back(heat_of(machine_of(record), taken, kind));
  }
  return heat;
}

/// Of so many tasks that one node has in a row, the mean of each of `columns` parts as equal as can be.
void append_means(std::vector<double>& means, std::span<const double> tasks, std::size_t columns) {
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = tasks.size() * column / columns, end = tasks.size() * (column + 1) / columns;
    const std::span<const double> part = tasks.subspan(first, end - first);
    means.push_back(part.empty() ? 0 : sum_of(part) / static_cast<double>(part.size()));
  }
}

}  // namespace

Losses losses_of(const PagedRecord& record) {
  if (machine_of(record) != nullptr) {
    constexpr WaitKinds waits = {.data = "page", .data_kinds = 1U << number_of(svm::Kind::page_reply)};
    std::vector<nodes::VirtualTimes> times;
    for (const PagedNode& node : record.nodes) {
      times.push_back(node.times);
    }
    return virtual_losses(times, waits);
  }
  std::vector<nodes::NodeCounters> clocks;
  for (const PagedNode& node : record.nodes) {
    clocks.push_back(node.clock);
  }
  return wall_losses(clocks);
}

std::vector<PacketKindTraffic> packets_of(const PagedRecord& record) {
  const PagedNode sum = record.sum();
  return {{"page request", sum.requests}, {"page reply", sum.replies}};
}

std::vector<OperationCount> operations_of(const PagedRecord& record) {
  const nodes::Machine* const machine = machine_of(record);
  const nodes::Charges charges = record.sum().charges;
  const auto counted_as = [&](std::string name, core::Charge charge, std::optional<double> today_ns) -> OperationCount {
    const std::uint64_t each_ps = machine == nullptr ? 0 : machine->cost_ps[static_cast<std::size_t>(charge)];
    return {std::move(name), charges[charge], today_ns, each_ps};
  };
  std::vector<OperationCount> operations;
  for (Index i = 0; i < record.operations.size(); ++i) {
    operations.push_back(counted_as(record.operations[i].name, charge_of(i), record.operations[i].nanoseconds));
  }
  if (machine != nullptr) {
    operations.push_back(counted_as("look-up of a page at home", core::Charge::home_lookup, {}));
    operations.push_back(counted_as("look-up of another page", core::Charge::cached_lookup, {}));
    operations.push_back(counted_as("page put into the cache", core::Charge::page_install, {}));
  }
  return operations;
}

Table node_table(const PagedRecord& record) {
  std::vector<Column> columns = {{"node", "", 0},   {"look-ups", "", 0}, {"at home", "", 0},      {"cache hits", "", 0},
                                 {"misses", "", 0}, {"faults", "", 0},   {"pages served", "", 0}, {"evictions", "", 0}};
  for (const OperationNeed& operation : record.operations) {
    columns.push_back({own_name(operation.name), "", 0});
  }
  columns.push_back({"memory", "KiB", 1});
  Table table("What each node did", std::move(columns));
  for (std::size_t number = 0; number < record.nodes.size(); ++number) {
    const PagedNode& node = record.nodes[number];
    const svm::PageCounters& pages = node.pages;
    std::vector<Cell> row = {std::uint64_t{number}, pages.references, pages.home_hits, pages.cache_hits,
                             pages.misses,          pages.faults,     pages.served,    pages.evictions};
    for (Index i = 0; i < record.operations.size(); ++i) {
      row.emplace_back(node.charges[charge_of(i)]);
    }
    row.emplace_back(kibibytes(node.memory_bytes));
    table.add_row(std::move(row));
  }
  return table;
}

Plot fault_plot() {
  return bars_by_node("node_faults", "Pages asked for and served", {.label = "", .least = 0},
                      {{"faults", "faults"}, {.title = "pages served", .column = "pages served", .color = 1}});
}

std::vector<TaskHeatKind> heat_kinds_of(const PagedRecord& record) {
  std::vector<TaskHeatKind> kinds;
  for (const TaskHeatKind kind : {TaskHeatKind::faults, TaskHeatKind::references, TaskHeatKind::computing}) {
    const bool is_known = kind != TaskHeatKind::computing || machine_of(record) != nullptr;
    if (is_known && sum_of(heat_by_task(record, kind)) > 0) {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

NumberMap heat_map(const PagedRecord& record, TaskHeatKind kind) {
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
    while (end < heat.size() && record.heat[end].node == node) {
      ++end;
    }
    append_means(map.values, std::span(heat).subspan(first, end - first), columns);
    first = end;
  }
  return map;
}

std::string heat_conclusion(const PagedRecord& record, TaskHeatKind kind) {
  return "The tenth of the tasks with the most " + words_of(kind) + " had " +
         share_text(top_tenth_share(heat_by_task(record, kind))) + " of all.";
}

Table hottest_tasks(const PagedRecord& record) {
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
    const svm::TaskTaken& taken = record.heat[task];
    std::vector<Cell> row = {std::uint64_t{task}, std::uint64_t{taken.node}, taken.steps, taken.references, taken.faults};
    if (kind == TaskHeatKind::computing) {
      row.emplace_back(heat[task] / 1000);
    }
    table.add_row(std::move(row));
  }
  return table;
}

}  // namespace dmpc::apps::html
