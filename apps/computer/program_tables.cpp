#include "apps/computer/program_tables.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "apps/computer/own_name.h"
#include "apps/computer/plan.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/node_table.h"
#include "apps/edge/show/page/shares.h"
#include "svm/pages/packets.h"

namespace dmpc::apps::html {
namespace {

/// By the packets that a node waits for.
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

/// What the program's own pieces of memory take.
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
  std::vector<PacketKindTraffic> packets;
  for (const NamedPacket& packet : record.vocabulary.packets) {
    packets.push_back({packet.name, sent[packet.kind]});
  }
  return packets;
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
  std::vector<double> sent_bytes;
  for (const ProgramNode& node : record.nodes) {
    sent_bytes.push_back(static_cast<double>(total(node.counters.sent).bytes));
  }
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
  std::vector<double> totals;
  for (const ProgramNode& node : record.nodes) {
    totals.push_back(static_cast<double>(node.memory.total()));
  }
  const std::size_t fullest = largest_at(totals);
  const ProgramNode& node = record.nodes[fullest];
  return "The fullest node, node " + std::to_string(fullest) + ", takes " + bytes_text(node.memory.total()) + ", of which " +
         bytes_text(node.memory[ProgramMemory::declared]) + " are what its program declares; it has allocated " +
         bytes_text(used_bytes(node)) + " of them.";
}

}  // namespace dmpc::apps::html
