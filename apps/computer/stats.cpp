// The counters of a program as JSON.
#include <nlohmann/json.hpp>

#include "apps/computer/record.h"
#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/stats/counters_json.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json traffic_json(const ProgramRecord& record, const nodes::TrafficByKind& sent) {
  Json all = Json::object();
  for (const NamedPacket& packet : record.vocabulary.packets) {
    all[packet.key] = {{"packets", sent[packet.kind].packets}, {"bytes", sent[packet.kind].bytes}};
  }
  return all;
}

Json operations_json(const ProgramRecord& record, const nodes::Charges& charges) {
  Json all = Json::object();
  for (const NamedOperation& operation : record.vocabulary.operations) {
    all[operation.name] = charges.count[operation.charge];
  }
  return all;
}

Json pages_json(const svm::PageCounters& pages) {
  Json all = json_of(pages);
  all.erase("hits");      // added below
  all.erase("distinct");  // not counted for tasks
  return all;
}

Json memory_json(const ProgramRecord& record, const ProgramNode& node) {
  Json bytes = {{"mailbox", node.memory[nodes::Category::mailbox]},
                {"queues", node.memory[nodes::Category::queues]},
                {"stack", node.memory[nodes::Category::reserve]},
                {"total", node.memory.total()}};
  for (Index i = 0; i < record.vocabulary.memory.size(); ++i) {
    bytes["of_program"][record.vocabulary.memory[i]] = node.used_bytes[i];
  }
  return bytes;
}

Json times_json(const ProgramRecord& record, const nodes::VirtualTimes& times) {
  Json waiting = Json::object();
  for (const NamedPacket& packet : record.vocabulary.packets) {
    waiting[packet.key] = times.waiting_ns[packet.kind];
  }
  return {{"computing_ns", times.computing_ns},
          {"sending_ns", times.sending_ns},
          {"receiving_ns", times.receiving_ns},
          {"waiting_ns", waiting},
          {"end_ns", times.end_ns}};
}

/// Returns the counters of one node of a program of tasks, or of all nodes.
Json task_node_json(const ProgramRecord& record, const ProgramNode& node) {
  return {{"pages", pages_json(node.pages)},
          {"packets", traffic_json(record, node.counters.sent)},
          {"operations", operations_json(record, node.charges)},
          {"memory_bytes", node.memory.total()},
          {"computing_ns", record.virtual_ns ? Json(node.times.computing_ns) : Json()}};
}

Json node_json(const ProgramRecord& record, const ProgramNode& node) {
  const nodes::NodeCounters& counters = node.counters;
  const nodes::Traffic out = total(counters.sent), in = total(counters.received);
  Json all = {
      {"packets_sent", out.packets}, {"bytes_sent", out.bytes}, {"packets_received", in.packets}, {"bytes_received", in.bytes}};
  all.update(json_of(counters));
  all["operations"] = operations_json(record, node.charges);
  all["memory_bytes"] = memory_json(record, node);
  all["virtual_time"] = record.virtual_ns ? times_json(record, node.times) : Json();
  return all;
}

Json tasks_json(const ProgramRecord& record) {
  const svm::TaskOptions& tasks = record.options.tasks;
  return {{"page_size_bytes", tasks.page_size_bytes},
          {"page_count", record.tasks.page_count},
          {"cache_pages", record.tasks.cache_pages},
          {"replacement", name_of(tasks.replacement)},
          {"in_flight", tasks.in_flight},
          {"runs", record.tasks.run_count},
          {"tasks", record.tasks.task_count}};
}

}  // namespace

std::string stats_json(const ProgramRecord& record) {
  const ProgramOptions& options = record.options;
  const nodes::Machine* const machine = options.computer.model();
  const bool has_pages = record.vocabulary.has_pages();
  const ProgramNode sum = record.sum();
  Json json = {{"format", json_format},
               {"program", record.name},
               {"result", record.result},
               {"nodes", record.node_count()},
               {"runner", name_of(options.runner)},
               {"machine", machine == nullptr ? Json() : Json(machine->name)},
               {"chaos", options.chaos_seed ? Json(*options.chaos_seed) : Json()}};
  if (has_pages) {
    json.update(tasks_json(record));
  }
  json["wall_seconds"] = record.wall_seconds;
  json["virtual_seconds"] = record.virtual_ns ? Json(1e-9 * static_cast<double>(*record.virtual_ns)) : Json();
  json["run_hash"] = record.run_hash ? Json(hash_text(*record.run_hash)) : Json();
  if (!has_pages) {
    json["packets"] = traffic_json(record, sum.counters.sent);
    json["operations"] = operations_json(record, sum.charges);
  }
  json["ranks"] = ranks_json(record.ranks, options.is_observed());
  if (has_pages) {
    json.update(task_node_json(record, sum));
  }
  json["per_node"] = Json::array();
  for (const ProgramNode& node : record.nodes) {
    json["per_node"].push_back(has_pages ? task_node_json(record, node) : node_json(record, node));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dmpc::apps
