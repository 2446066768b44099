#include "apps/computer/program_tables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "apps/computer/own_name.h"
#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/page/shares.h"

namespace dmpc::apps::html {
namespace {

std::uint32_t node_count_of(const ProgramRecord& record) { return record.plan.node_count(); }

Losses virtual_losses_of(const ProgramRecord& record) {
  const std::vector<PacketNeed>& packets = record.plan.needs().packets;
  Losses losses{.parts = {"computing"}, .is_virtual = true};
  for (const PacketNeed& packet : packets) {
    losses.parts.push_back("waiting for " + packet.name);
  }
  losses.parts.insert(losses.parts.end(), {"messages", "idle at the end"});
  for (std::uint32_t node = 0; node < node_count_of(record); ++node) {
    const nodes::VirtualTimes& times = record.virtual_time->nodes[node];
    std::vector<std::uint64_t> parts = {times.computing_ns};
    parts.insert(parts.end(), times.waiting_ns.begin(), times.waiting_ns.begin() + static_cast<std::ptrdiff_t>(packets.size()));
    parts.insert(parts.end(), {times.sending_ns + times.receiving_ns, times.end_ns});
    losses.nodes.push_back(std::move(parts));
  }
  return without_empty_parts(losses);
}

/// Of the program's own pieces of memory.
std::size_t used_bytes(const ProgramRecord& record, std::uint32_t node) {
  const std::vector<std::size_t>& used = record.nodes[node].used_bytes;
  return std::accumulate(used.begin(), used.end(), std::size_t{0});
}

std::size_t fullest_node(const ProgramRecord& record) {
  std::vector<double> totals;
  for (std::uint32_t node = 0; node < node_count_of(record); ++node) {
    totals.push_back(static_cast<double>(record.plan.memory(node).total()));
  }
  return largest_at(totals);
}

}  // namespace

Losses losses_of(const ProgramRecord& record) {
  if (record.virtual_time) {
    return virtual_losses_of(record);
  }
  std::vector<nodes::NodeCounters> counters;
  for (const ProgramNode& node : record.nodes) {
    counters.push_back(node.counters);
  }
  return wall_losses(counters);
}

std::vector<PacketKindTraffic> packets_of(const ProgramRecord& record) {
  std::vector<PacketKindTraffic> packets;
  for (Index packet = 0; packet < record.plan.needs().packets.size(); ++packet) {
    packets.push_back({record.plan.needs().packets[packet].name, sent(record, packet)});
  }
  return packets;
}

std::vector<OperationCount> operations_of(const ProgramRecord& record) {
  const std::vector<OperationNeed>& needs = record.plan.needs().operations;
  const nodes::Machine* const machine = record.options.computer.model();
  std::vector<OperationCount> operations;
  for (Index i = 0; i < needs.size(); ++i) {
    std::uint64_t count = 0;
    for (const ProgramNode& node : record.nodes) {
      count += node.charges.count[i];
    }
    operations.push_back({needs[i].name, count, needs[i].nanoseconds, machine == nullptr ? 0 : machine->cost_ps[i]});
  }
  return operations;
}

Table node_table(const ProgramRecord& record) {
  std::vector<Column> columns = {
      {"node", "", 0},          {"packets sent", "", 0}, {"sent", "bytes", 0},    {"packets received", "", 0},
      {"received", "bytes", 0}, {"refused", "", 0},      {"calls of work", "", 0}};
  for (const OperationNeed& operation : record.plan.needs().operations) {
    columns.push_back({own_name(operation.name), "", 0});
  }
  Table table("What each node did", std::move(columns));
  for (std::uint32_t node = 0; node < node_count_of(record); ++node) {
    const nodes::NodeCounters& counters = record.nodes[node].counters;
    const nodes::Traffic out = total(counters.sent), in = total(counters.received);
    std::vector<Cell> row = {std::uint64_t{node}, out.packets,    out.bytes, in.packets, in.bytes,
                             counters.refused,    counters.quanta};
    const nodes::Charges charges = record.nodes[node].charges;
    for (Index i = 0; i < record.plan.needs().operations.size(); ++i) {
      row.emplace_back(charges.count[i]);
    }
    table.add_row(std::move(row));
  }
  return table;
}

Plot packet_plot() {
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
  const std::vector<MemoryNeed>& needs = record.plan.needs().memory;
  std::vector<Column> columns = {{"node", "", 0}, {"mailbox", "KiB", 1}, {"queues", "KiB", 1}, {"stack", "KiB", 1}};
  for (const MemoryNeed& need : needs) {
    columns.push_back({own_name(need.name), "KiB", 1});
  }
  columns.insert(columns.end(), {{"declared and not used", "KiB", 1}, {"planned", "KiB", 1}});
  Table table("Memory of each node", std::move(columns));
  for (std::uint32_t node = 0; node < node_count_of(record); ++node) {
    const nodes::MemoryPlan plan = record.plan.memory(node);
    std::vector<Cell> row = {std::uint64_t{node}, kibibytes(plan[nodes::Category::mailbox]),
                             kibibytes(plan[nodes::Category::queues]), kibibytes(plan[nodes::Category::reserve])};
    for (const std::size_t bytes : record.nodes[node].used_bytes) {
      row.emplace_back(kibibytes(bytes));
    }
    const std::size_t unused = plan[ProgramMemory::declared] - used_bytes(record, node);
    row.insert(row.end(), {kibibytes(unused), kibibytes(plan.total())});
    table.add_row(std::move(row));
  }
  return table;
}

Plot memory_plot(const ProgramRecord& record) {
  std::vector<Column> columns = memory_table(record).columns();
  columns.pop_back();  // the sum of the others
  return stacked_by_node("memory", "Memory of each node", {.label = "", .least = 0}, columns);
}

std::string memory_conclusion(const ProgramRecord& record) {
  const std::size_t fullest = fullest_node(record);
  const auto node = static_cast<std::uint32_t>(fullest);
  const nodes::MemoryPlan plan = record.plan.memory(node);
  return "The fullest node, node " + std::to_string(fullest) + ", takes " + bytes_text(plan.total()) + ", of which " +
         bytes_text(plan[ProgramMemory::declared]) + " are what its program declares; it has allocated " +
         bytes_text(used_bytes(record, node)) + " of them.";
}

}  // namespace dmpc::apps::html
