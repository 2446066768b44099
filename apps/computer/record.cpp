#include "apps/computer/record.h"

#include <algorithm>
#include <array>

#include "apps/edge/line/amount.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/trace/chrome.h"
#include "apps/edge/show/trace/paje.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What a program does without an operation of its own.
constexpr std::array<const char*, span_names.size()> activity_names = {
    "compute", "compute", "compute", "compute", "compute", "compute", "serve", "send packets", "take packet"};

std::size_t memory_max_bytes(const ProgramRecord& record) {
  std::size_t most = 0;
  for (std::uint32_t node = 0; node < record.plan.node_count(); ++node) {
    most = std::max(most, record.plan.memory(node).total());
  }
  return most;
}

std::uint64_t computing_ns(const nodes::VirtualReport& report, std::uint32_t node_count) {
  std::uint64_t sum = 0;
  for (std::uint32_t node = 0; node < node_count; ++node) {
    sum += report.nodes[node].computing_ns;
  }
  return sum;
}

}  // namespace

nodes::Traffic sent(const ProgramRecord& record, Index packet) {
  nodes::Traffic sum;
  for (const ProgramNode& node : record.nodes) {
    sum += node.counters.sent[packet];
  }
  return sum;
}

nodes::Traffic sent(const ProgramRecord& record) {
  nodes::Traffic sum;
  for (Index packet = 0; packet < record.plan.needs().packets.size(); ++packet) {
    sum += sent(record, packet);
  }
  return sum;
}

std::string computer_text(const ProgramOptions& options) {
  const nodes::Machine* const machine = options.computer.model();
  const std::string kind = options.runner == RunnerKind::mpi ? " on ranks"
                           : machine == nullptr              ? " on threads"
                                                             : " of " + machine->name;
  return counted(options.computer.node_count, "node") + kind;
}

std::string ranks_text(const std::vector<nodes::RankFigures>& ranks) {
  std::uint64_t packets = 0;
  for (const nodes::RankFigures& rank : ranks) {
    packets += rank.traffic.packets_sent;
  }
  return ranks.empty() ? "" : "; " + counted(packets, "packet") + " between " + counted(ranks.size(), "rank");
}

std::string virtual_time_text(std::uint64_t total_ns, std::uint64_t computing_ns, std::uint32_t node_count) {
  const double share = percent_of(static_cast<double>(computing_ns), static_cast<double>(total_ns) * node_count);
  return amount_text(static_cast<double>(total_ns), "ns") + " of virtual time, " + percent_text(share) + " of it computing";
}

std::string summary(const ProgramRecord& record) {
  const std::uint32_t node_count = record.plan.node_count();
  std::string text = computer_text(record.options) + ": ";
  text += record.virtual_time
              ? virtual_time_text(record.virtual_time->total_ns, computing_ns(*record.virtual_time, node_count), node_count)
              : seconds_text(record.wall_seconds);
  const nodes::Traffic traffic = sent(record);
  return text + "; " + counted(traffic.packets, "packet") + ", " + bytes_text(traffic.bytes) + ranks_text(record.ranks) + "; " +
         bytes_text(memory_max_bytes(record)) + " of memory a node\n";
}

void write_trace(const ProgramRecord& record, std::ostream& output) {
  core::expect(record.trace.has_value(), "a trace that is written was recorded");
  std::vector<const char*> kind_names;
  for (const PacketNeed& packet : record.plan.needs().packets) {
    kind_names.push_back(packet.name.c_str());
  }
  std::vector<const char*> operation_names;
  for (const OperationNeed& operation : record.plan.needs().operations) {
    operation_names.push_back(operation.name.c_str());
  }
  write_view(
      {.trace = *record.trace, .kind_names = kind_names, .activity_names = activity_names, .operation_names = operation_names},
      record.name, record.options, output);
}

void write_view(TraceView view, const std::string& name, const ProgramOptions& options, std::ostream& output) {
  view.clock = options.is_modelled() ? "virtual time" : "wall clock";
  view.remarks = {
      {"program", name},
      {"computer", computer_text(options)},
      {"lost", view.trace.events_lost == 0 ? "nothing" : counted(view.trace.events_lost, "event") + ": the trace is full"}};
  options.trace->extension() == ".paje" ? write_paje(view, output) : write_chrome(view, output);
}

}  // namespace dmpc::apps
