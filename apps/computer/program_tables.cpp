#include "apps/computer/program_tables.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "apps/computer/declared.h"
#include "apps/computer/plan.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/node_table.h"
#include "apps/frontend/show/page/shares.h"
#include "core/base/ranges.h"
#include "svm/pages/packets.h"

namespace dmpc::apps::html {
namespace {

constexpr std::size_t tasks_listed = 20;
/// The maximum number of columns for a node's tasks in a heat map.
constexpr std::size_t heat_columns_max = 128;

const nodes::Machine* machine_of(const ProgramRecord& record) { return record.options.computer.model(); }

/// Returns counts, or nanoseconds of computing.
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
  return core::mapped<double>(record.tasks.heat,
                              [&](const svm::TaskTaken& taken) { return heat_of(machine_of(record), taken, kind); });
}

/// Divides a node's consecutive tasks into `columns` parts of nearly equal size, and appends the mean of each.
void append_means(std::vector<double>& means, std::span<const double> tasks, std::size_t columns) {
  for (std::size_t column = 0; column < columns; ++column) {
    const std::size_t first = tasks.size() * column / columns, end = tasks.size() * (column + 1) / columns;
    const std::span<const double> part = tasks.subspan(first, end - first);
    means.push_back(part.empty() ? 0 : sum_of(part) / static_cast<double>(part.size()));
  }
}

/// Losses by the packets that a node waits for.
Losses packet_losses(const ProgramRecord& record) {
  Losses losses{.parts = {"computing"}, .is_virtual = true};
  for (const NamedPacket& packet : record.vocabulary.packets) {
    losses.parts.push_back("waiting for " + packet.name);
  }
  losses.parts.insert(losses.parts.end(), {"messages", "idle at the end"});
  for (const ProgramNode& node : record.nodes) {
    std::vector<std::uint64_t>& parts = losses.nodes.emplace_back(1, node.times.computing_ns);
    for (const NamedPacket& packet : record.vocabulary.packets) {
      parts.push_back(node.times.waiting_ns[packet.kind]);
    }
    parts.insert(parts.end(), {node.times.sending_ns + node.times.receiving_ns, node.times.end_ns});
  }
  return without_empty_parts(losses);
}

/// Returns the bytes of the program's own pieces of memory.
std::size_t used_bytes(const ProgramNode& node) {
  return std::accumulate(node.used_bytes.begin(), node.used_bytes.end(), std::size_t{0});
}

NodeColumns operation_columns(const ProgramRecord& record) {
  NodeColumns columns;
  for (const NamedOperation& operation : record.vocabulary.operations) {
    columns.push_back(count_column(own_name(operation.name),
                                   [&](std::size_t node) { return record.nodes[node].charges.count[operation.charge]; }));
  }
  return columns;
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

Losses losses_of(const ProgramRecord& record) {
  std::vector<nodes::NodeCounters> counters;
  std::vector<nodes::VirtualTimes> times;
  for (const ProgramNode& node : record.nodes) {
    counters.push_back(node.counters);
    times.push_back(node.times);
  }
  if (record.options.computer.model() == nullptr) {
    return wall_losses(counters);
  }
  constexpr WaitKinds waits = {.data = "page", .data_kinds = 1U << number_of(svm::Kind::page_reply)};
  return record.vocabulary.has_pages() ? virtual_losses(times, waits) : packet_losses(record);
}

std::vector<PacketKindTraffic> packets_of(const ProgramRecord& record) {
  const nodes::TrafficByKind sent = record.sum().counters.sent;
  return core::mapped<PacketKindTraffic>(record.vocabulary.packets, [&](const NamedPacket& packet) {
    return PacketKindTraffic{packet.name, sent[packet.kind]};
  });
}

std::vector<OperationCount> operations_of(const ProgramRecord& record) {
  const nodes::Machine* const machine = record.options.computer.model();
  const nodes::Charges charges = record.sum().charges;
  std::vector<OperationCount> operations;
  const auto add = [&](const NamedOperation& operation, std::optional<double> today_ns) {
    const std::uint64_t each_ps = machine == nullptr ? 0 : machine->cost_ps[operation.charge];
    operations.push_back({operation.name, charges.count[operation.charge], today_ns, each_ps});
  };
  for (const NamedOperation& operation : record.vocabulary.operations) {
    add(operation, operation.nanoseconds);
  }
  if (machine != nullptr) {
    for (const NamedOperation& operation : record.vocabulary.of_pages) {
      add(operation, std::nullopt);
    }
  }
  return operations;
}

Table node_table(const ProgramRecord& record) {
  const auto counters = [&](std::size_t node) -> const nodes::NodeCounters& { return record.nodes[node].counters; };
  const auto pages = [&](std::size_t node) -> const svm::PageCounters& { return record.nodes[node].pages; };
  const bool has_pages = record.vocabulary.has_pages();
  NodeColumns columns = has_pages ? counter_columns<svm::PageCounters>(pages) : traffic_columns(counters);
  if (!has_pages) {
    append(columns, counter_columns<nodes::NodeCounters>(counters));
  }
  append(columns, operation_columns(record));
  if (has_pages) {
    columns.push_back(kibibyte_column("memory", [&](std::size_t node) { return record.nodes[node].memory.total(); }));
  }
  return node_table("What each node did", record.nodes.size(), columns);
}

Plot node_plot(const ProgramRecord& record) {
  if (record.vocabulary.has_pages()) {
    return fault_plot();
  }
  return bars_by_node(
      "node_packets", "Packets that each node sent and received", {.label = "", .least = 0},
      {{"packets sent", "packets sent"}, {.title = "packets received", .column = "packets received", .color = 1}});
}

std::string node_conclusion(const ProgramRecord& record) {
  const std::vector<double> sent_bytes = core::mapped<double>(
      record.nodes, [&](const ProgramNode& node) { return static_cast<double>(total(node.counters.sent).bytes); });
  const std::string even = evenness(sent_bytes, "sent");
  return even.empty() ? "" : even + " number of bytes.";
}

Table memory_table(const ProgramRecord& record) {
  const auto of_plan = [&](const std::string& name, nodes::Category category) {
    return kibibyte_column(name, [&record, category](std::size_t node) { return record.nodes[node].memory[category]; });
  };
  NodeColumns columns = {of_plan("mailbox", nodes::Category::mailbox), of_plan("queues", nodes::Category::queues),
                         of_plan("stack", nodes::Category::reserve)};
  for (Index piece = 0; piece < record.vocabulary.memory.size(); ++piece) {
    columns.push_back(kibibyte_column(own_name(record.vocabulary.memory[piece]),
                                      [&record, piece](std::size_t node) { return record.nodes[node].used_bytes[piece]; }));
  }
  columns.push_back(kibibyte_column("declared and not used", [&](std::size_t node) {
    return record.nodes[node].memory[ProgramMemory::declared] - used_bytes(record.nodes[node]);
  }));
  columns.push_back(kibibyte_column("planned", [&](std::size_t node) { return record.nodes[node].memory.total(); }));
  return node_table("Memory of each node", record.nodes.size(), columns);
}

Plot memory_plot(const ProgramRecord& record) {
  std::vector<Column> columns = memory_table(record).columns();
  columns.pop_back();  // the sum of the others
  return stacked_by_node("memory", "Memory of each node", {.label = "", .least = 0}, columns);
}

std::string memory_conclusion(const ProgramRecord& record) {
  const std::vector<double> totals =
      core::mapped<double>(record.nodes, [&](const ProgramNode& node) { return static_cast<double>(node.memory.total()); });
  const std::size_t fullest = largest_at(totals);
  const ProgramNode& node = record.nodes[fullest];
  return "The fullest node, node " + std::to_string(fullest) + ", takes " + bytes_text(node.memory.total()) + ", of which " +
         bytes_text(node.memory[ProgramMemory::declared]) + " are what its program declares; it has allocated " +
         bytes_text(used_bytes(node)) + " of them.";
}

}  // namespace dmpc::apps::html
