// The counters of a program's run as JSON.
#include <nlohmann/json.hpp>

#include "apps/computer/record.h"
#include "apps/edge/line/json_format.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/stats/ranks.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json packets_json(const ProgramRecord& record) {
  Json all = Json::object();
  const std::vector<PacketNeed>& packets = record.plan.needs().packets;
  for (Index i = 0; i < packets.size(); ++i) {
    const nodes::Traffic traffic = sent(record, i);
    all[packets[i].name] = {{"packets", traffic.packets}, {"bytes", traffic.bytes}};
  }
  return all;
}

Json operations_json(const ProgramRecord& record, const nodes::Charges& charges) {
  Json all = Json::object();
  const std::vector<OperationNeed>& operations = record.plan.needs().operations;
  for (Index i = 0; i < operations.size(); ++i) {
    all[operations[i].name] = charges.count[i];
  }
  return all;
}

nodes::Charges charges_of_all(const ProgramRecord& record) {
  nodes::Charges sum;
  for (const ProgramNode& node : record.nodes) {
    sum += node.charges;
  }
  return sum;
}

Json memory_json(const ProgramRecord& record, std::uint32_t node) {
  const nodes::MemoryPlan plan = record.plan.memory(node);
  Json bytes = {{"mailbox", plan[nodes::Category::mailbox]},
                {"queues", plan[nodes::Category::queues]},
                {"stack", plan[nodes::Category::reserve]},
                {"total", plan.total()}};
  const std::vector<MemoryNeed>& memory = record.plan.needs().memory;
  for (Index i = 0; i < memory.size(); ++i) {
    bytes["of_program"][memory[i].name] = record.nodes[node].used_bytes[i];
  }
  return bytes;
}

Json times_json(const ProgramRecord& record, const nodes::VirtualTimes& times) {
  Json waiting = Json::object();
  const std::vector<PacketNeed>& packets = record.plan.needs().packets;
  for (Index i = 0; i < packets.size(); ++i) {
    waiting[packets[i].name] = times.waiting_ns[i];
  }
  return {{"computing_ns", times.computing_ns},
          {"sending_ns", times.sending_ns},
          {"receiving_ns", times.receiving_ns},
          {"waiting_ns", waiting},
          {"end_ns", times.end_ns}};
}

Json node_json(const ProgramRecord& record, std::uint32_t node) {
  const nodes::NodeCounters& counters = record.nodes[node].counters;
  const nodes::Traffic out = total(counters.sent), in = total(counters.received);
  return {{"packets_sent", out.packets},
          {"bytes_sent", out.bytes},
          {"packets_received", in.packets},
          {"bytes_received", in.bytes},
          {"refused", counters.refused},
          {"quanta", counters.quanta},
          {"operations", operations_json(record, record.nodes[node].charges)},
          {"memory_bytes", memory_json(record, node)},
          {"virtual_time", record.virtual_time ? times_json(record, record.virtual_time->nodes[node]) : Json()}};
}

}  // namespace

std::string stats_json(const ProgramRecord& record) {
  const nodes::Machine* const machine = record.options.computer.model();
  Json json = {
      {"format", json_format},
      {"program", record.name},
      {"result", record.result},
      {"nodes", record.plan.node_count()},
      {"runner", name_of(record.options.runner)},
      {"machine", machine == nullptr ? Json() : Json(machine->name)},
      {"chaos", record.options.chaos_seed ? Json(*record.options.chaos_seed) : Json()},
      {"wall_seconds", record.wall_seconds},
      {"virtual_seconds", record.virtual_time ? Json(1e-9 * static_cast<double>(record.virtual_time->total_ns)) : Json()},
      {"run_hash", record.virtual_time ? Json(hash_text(record.virtual_time->run_hash(0))) : Json()},
      {"packets", packets_json(record)},
      {"operations", operations_json(record, charges_of_all(record))},
      {"ranks", ranks_json(record.ranks, record.options.is_observed())},
      {"per_node", Json::array()}};
  for (std::uint32_t node = 0; node < record.plan.node_count(); ++node) {
    json["per_node"].push_back(node_json(record, node));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dmpc::apps
