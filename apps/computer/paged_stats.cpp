// The counters of a program of tasks as JSON.
#include <nlohmann/json.hpp>

#include "apps/computer/paged_record.h"
#include "apps/edge/line/json_format.h"
#include "apps/edge/line/number_text.h"
#include "apps/edge/show/stats/ranks.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;

Json traffic_json(const nodes::Traffic& traffic) { return {{"packets", traffic.packets}, {"bytes", traffic.bytes}}; }

Json pages_json(const svm::PageCounters& pages) {
  return {{"references", pages.references}, {"home_hits", pages.home_hits}, {"cache_hits", pages.cache_hits},
          {"misses", pages.misses},         {"faults", pages.faults},       {"evictions", pages.evictions},
          {"served", pages.served}};
}

Json operations_json(const PagedRecord& record, const nodes::Charges& charges) {
  Json all = Json::object();
  for (Index i = 0; i < record.operations.size(); ++i) {
    all[record.operations[i].name] = charges[charge_of(i)];
  }
  return all;
}

Json node_json(const PagedRecord& record, const PagedNode& node) {
  return {{"pages", pages_json(node.pages)},
          {"packets", {{"page_request", traffic_json(node.requests)}, {"page_reply", traffic_json(node.replies)}}},
          {"operations", operations_json(record, node.charges)},
          {"memory_bytes", node.memory_bytes},
          {"computing_ns", record.virtual_ns ? Json(node.times.computing_ns) : Json()}};
}

}  // namespace

std::string stats_json(const PagedRecord& record) {
  const ProgramOptions& options = record.options.program;
  const nodes::Machine* const machine = options.computer.model();
  Json json = {{"format", json_format},
               {"program", record.name},
               {"result", record.result},
               {"nodes", options.computer.node_count},
               {"runner", name_of(options.runner)},
               {"machine", machine == nullptr ? Json() : Json(machine->name)},
               {"chaos", options.chaos_seed ? Json(*options.chaos_seed) : Json()},
               {"page_size_bytes", record.options.tasks.page_size_bytes},
               {"page_count", record.page_count},
               {"cache_pages", record.cache_pages},
               {"replacement", name_of(record.options.tasks.replacement)},
               {"in_flight", record.options.tasks.in_flight},
               {"runs", record.run_count},
               {"tasks", record.task_count},
               {"wall_seconds", record.wall_seconds},
               {"virtual_seconds", record.virtual_ns ? Json(1e-9 * static_cast<double>(*record.virtual_ns)) : Json()},
               {"run_hash", record.run_hash ? Json(hash_text(*record.run_hash)) : Json()},
               {"ranks", ranks_json(record.ranks, options.is_observed())}};
  json.update(node_json(record, record.sum()));
  json["per_node"] = Json::array();
  for (const PagedNode& node : record.nodes) {
    json["per_node"].push_back(node_json(record, node));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dmpc::apps
