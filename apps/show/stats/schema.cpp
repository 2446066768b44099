#include "apps/show/stats/schema.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string_view>
#include <vector>

#include "apps/frontend/show/stats/counters_json.h"
#include "apps/run/memory_categories.h"
#include "apps/run/strategy_rows.h"
#include "apps/show/counters.h"
#include "apps/show/stats/strategy.h"
#include "core/base/expect.h"
#include "core/trace/charge.h"
#include "core/trace/skips.h"
#include "dataflow/packets.h"
#include "svm/packets.h"

namespace dmpc::apps {

extern const char* const stats_schema_form;  // defined in a source that CMake generates from the file

namespace {

Json with_description(Json schema, std::string_view description) {
  if (!description.empty()) {
    schema["description"] = description;
  }
  return schema;
}

Json reference_to(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }
Json count_or_null() { return {{"type", {"integer", "null"}}, {"minimum", 0}}; }

template <class T, std::size_t count>
Json counters(const std::array<Counter<T>, count>& rows) {
  Json all;
  for (const Counter<T>& row : rows) {
    all[row.key] = with_description(row.may_be_null ? count_or_null() : reference_to("count"), row.help);
  }
  return all;
}

/// Returns figures with the names of a table's rows, each defined by `schema`.
template <class Table, class NameOf>
Json named(const Table& table, const NameOf& name_of_each, const std::string& schema) {
  Json all;
  for (const auto& each : table) {
    all[key_of(name_of_each(each))] = reference_to(schema);
  }
  return all;
}

Json strategy_options() {
  const auto type_of = [](OptionKind kind) -> Json {
    return kind == OptionKind::number ? count_or_null()
                                      : Json{{"type", {kind == OptionKind::flag ? "boolean" : "string", "null"}}};
  };
  Json all;
  for (const ReportedKey& reported : reported_keys()) {
    all[std::string(reported.key)] = with_description(type_of(reported.kind), reported.meaning);
  }
  return all;
}

/// Tasks have no hits and do not count their pages.
Json pages_of_tasks() {
  Json all = counters(counters_of<svm::PageCounters>);
  all.erase("hits");
  all.erase("distinct");
  return all;
}

/// Returns the figures of one node of a program of tasks, or of all: apps/computer/stats.cpp.
Json task_node() {
  return {{"pages", reference_to("task_pages")},
          {"packets", reference_to("named_packets")},
          {"operations", reference_to("named_operations")},
          {"memory_bytes", reference_to("count")},
          {"computing_ns", count_or_null()}};
}

Json packet_kinds() {
  std::vector<std::string> names(svm::kind_names.begin(), svm::kind_names.end());
  std::copy_if(dataflow::kind_names.begin(), dataflow::kind_names.end(), std::back_inserter(names),
               [&](const char* name) { return std::find(names.begin(), names.end(), name) == names.end(); });
  return names;
}

/// Returns the rows that replace "*name" in the form.
const Json& rows_called(const std::string& name) {
  static const std::map<std::string, Json> rows = {
      {"options of strategies", strategy_options()},
      {"hits", counters(hit_counters)},
      {"operations", counters(counters_of<core::Operations>)},
      {"pages", counters(counters_of<svm::PageCounters>)},
      {"work", counters(counters_of<svm::WorkCounters>)},
      {"questions", counters(counters_of<svm::QuestionCounters>)},
      {"gather", counters(counters_of<dataflow::Gather::Counters>)},
      {"overflow", counters(overflow_counters)},
      {"travelling rays", counters(counters_of<dataflow::RayCounters>)},
      {"queue", counters(queue_counters)},
      {"backlog", counters(counters_of<dataflow::ProgramCounts>)},
      {"movement", counters(counters_of<dataflow::MovementCounters>)},
      {"prices", named(
                     core::charge_names, [](std::string_view charge) { return std::string(charge); }, "count")},
      {"skips", named(
                    core::all_skips, [](const core::Skip& skip) { return skip.name; }, "skip")},
      {"memory", named(
                     memory_categories, [](const NamedCategory& category) { return category.name; }, "count")},
      {"node counters", counters(counters_of<nodes::NodeCounters>)},
      {"pages of tasks", pages_of_tasks()},
      {"task node", task_node()},
      {"packet kinds", packet_kinds()}};
  const auto found = rows.find(name);
  core::expect(found != rows.end(), "the form of the schema names rows that are there");
  return found->second;
}

bool is_name_of_rows(const std::string& word) { return word.rfind('*', 0) == 0; }

Json completed(const Json& form);

Json completed_properties(const Json& form) {
  Json properties;
  for (const auto& [key, value] : form.items()) {
    if (is_name_of_rows(key)) {
      properties.update(rows_called(key.substr(1)));
    } else {
      properties[key] = completed(value);
    }
  }
  return properties;
}

/// Completes an object with these properties.
void close_object(Json& object, const Json& properties) {
  object.emplace("type", "object");
  object["additionalProperties"] = false;
  for (const auto& [key, unused] : properties.items()) {
    object["required"].push_back(key);
  }
  object["properties"] = properties;
}

Json completed(const Json& form) {
  if (form.is_array() && form.size() == 1 && form[0].is_string() && is_name_of_rows(form[0].get<std::string>())) {
    return rows_called(form[0].get<std::string>().substr(1));
  }
  Json result = form;
  for (const auto& [key, value] : result.items()) {
    if (key != "properties" && value.is_structured()) {
      value = completed(value);
    }
  }
  if (form.is_object() && form.contains("properties")) {
    const Json properties = completed_properties(form["properties"]);
    result.erase("properties");
    close_object(result, properties);
  }
  return result;
}

}  // namespace

const std::string& stats_schema() {
  static const std::string schema = completed(Json::parse(stats_schema_form)).dump(2) + "\n";
  return schema;
}

}  // namespace dmpc::apps
