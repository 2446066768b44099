#include "apps/computer/record.h"

#include <algorithm>
#include <array>

#include "apps/line/amount.h"
#include "apps/line/number_text.h"
#include "apps/show/trace/chrome.h"
#include "apps/show/trace/paje.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// A program's own operations have no names in a trace yet: all of them are computing.
constexpr std::array<const char*, span_names.size()> activity_names = {
    "compute", "compute", "compute", "compute", "compute", "compute", "serve", "send packets", "take packet"};

std::size_t memory_max_bytes(const ProgramRecord& record) {
  std::size_t most = 0;
  for (std::uint32_t node = 0; node < record.plan.node_count(); ++node) {
    most = std::max(most, record.plan.memory(node).total());
  }
  return most;
}

/// Of all nodes' time.
double computing_percent(const nodes::VirtualReport& report, std::uint32_t node_count) {
  std::uint64_t computing_ns = 0;
  for (std::uint32_t node = 0; node < node_count; ++node) {
    computing_ns += report.nodes[node].computing_ns;
  }
  return percent_of(static_cast<double>(computing_ns), static_cast<double>(report.total_ns) * node_count);
}

}  // namespace

nodes::Traffic sent(const ProgramRecord& record, Index packet) {
  nodes::Traffic sum;
  for (const nodes::NodeCounters* counters : record.counters) {
    sum.packets += counters->sent[packet].packets;
    sum.bytes += counters->sent[packet].bytes;
  }
  return sum;
}

nodes::Traffic sent(const ProgramRecord& record) {
  nodes::Traffic sum;
  for (Index packet = 0; packet < record.plan.needs().packets.size(); ++packet) {
    sum.packets += sent(record, packet).packets;
    sum.bytes += sent(record, packet).bytes;
  }
  return sum;
}

std::string computer_text(const ProgramRecord& record) {
  const nodes::Machine* const machine = record.options.computer.model();
  return counted(record.plan.node_count(), "node") + (machine == nullptr ? " on threads" : " of " + machine->name);
}

std::string summary(const ProgramRecord& record) {
  std::string text = computer_text(record) + ": ";
  if (record.virtual_time) {
    text += amount_text(static_cast<double>(record.virtual_time->total_ns), "ns") + " of virtual time, " +
            percent_text(computing_percent(*record.virtual_time, record.plan.node_count())) + " of it computing";
  } else {
    text += seconds_text(record.wall_seconds);
  }
  const nodes::Traffic traffic = sent(record);
  return text + "; " + counted(traffic.packets, "packet") + ", " + bytes_text(traffic.bytes) + "; " +
         bytes_text(memory_max_bytes(record)) + " of memory a node\n";
}

void write_trace(const ProgramRecord& record, std::ostream& output) {
  core::expect(record.trace.has_value(), "a trace that is written was recorded");
  std::vector<const char*> kind_names;
  for (const PacketNeed& packet : record.plan.needs().packets) {
    kind_names.push_back(packet.name.c_str());
  }
  const TraceView view{
      .trace = *record.trace,
      .kind_names = kind_names,
      .clock = record.virtual_time ? "virtual time" : "wall clock",
      .remarks = {{"program", record.name},
                  {"computer", computer_text(record)},
                  {"lost", record.trace->events_lost == 0 ? "nothing"
                                                          : counted(record.trace->events_lost, "event") + ": the trace is full"}},
      .activity_names = activity_names};
  record.options.trace->extension() == ".paje" ? write_paje(view, output) : write_chrome(view, output);
}

}  // namespace dmpc::apps
