// stats.schema.json, held against the counters of every kind of run by Debian's python3-jsonschema.

#include <doctest/doctest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/run/strategy_rows.h"
#include "apps/run/systems.h"
#include "apps/show/counters.h"
#include "apps/show/stats/schema.h"
#include "nodes/ranks/rank_links.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/loopback_ranks.h"
#include "tests/support/mesh_files.h"
#include "tests/support/stats_validator.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::schema_test {

namespace {

using tests::faults_by_schema;
using tests::has_validator;
using tests::TemporaryFolder;

struct Kind {
  const char* name;
  std::function<RenderOptions()> options;
};

RenderOptions changed(RenderOptions options, const std::function<void(RenderOptions&)>& change) {
  change(options);
  return options;
}

/// A computer of each strategy, runner and kind of figures that are null for others.
std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow, Strategy::forest}) {
    kinds.push_back({name_of(strategy), [=] { return small(strategy); }});
    kinds.push_back({"virtual", [=] { return modelled(strategy); }});
    kinds.push_back(
        {"disturbed",
         [=] { return changed(small(strategy), [](RenderOptions& options) { options.computer.chaos = nodes::chaos_of(1); }); }});
    kinds.push_back(
        {"refined", [=] { return changed(small(strategy), [](RenderOptions& options) { options.picture.is_refined = true; }); }});
  }
  kinds.push_back({"memory ports", [] {
                     return changed(modelled(), [](RenderOptions& options) { options.computer.machine->has_memory_port = true; });
                   }});
  kinds.push_back({"counted pages in a tree, with heat maps", [] {
                     return changed(small(), [](RenderOptions& options) {
                       options.pages.count_pages = true;
                       options.pages.homes = svm::PageHomes::tree;
                       options.heat_maps = {parse_heat_request("time:t.exr"), parse_heat_request("faults:f.png")};
                     });
                   }});
  kinds.push_back({"pages at the host",
                   [] { return changed(small(), [](RenderOptions& options) { options.pages.homes = svm::PageHomes::host; }); }});
  kinds.push_back({"heat maps of virtual time", [] {
                     return changed(modelled(),
                                    [](RenderOptions& options) { options.heat_maps = {parse_heat_request("time:t.exr")}; });
                   }});
  kinds.push_back({"regions of equal size", [] {
                     return changed(small(Strategy::dataflow),
                                    [](RenderOptions& options) { options.rays.balance.balance = dataflow::Balance::equal_size; });
                   }});
  kinds.push_back({"scattered regions", [] {
                     return changed(small(Strategy::dataflow),
                                    [](RenderOptions& options) { options.rays.balance.balance = dataflow::Balance::scattered; });
                   }});
  kinds.push_back({"moving regions", [] {
                     return changed(small(Strategy::dataflow), [](RenderOptions& options) {
                       options.rays.balance = {.balance = dataflow::Balance::moving, .regions_a_node = 4};
                     });
                   }});
  kinds.push_back({"shared places", [] {
                     return changed(small(Strategy::dataflow), [](RenderOptions& options) { options.computer.node_count = 130; });
                   }});
  kinds.push_back(
      {"a system by name", [] { return changed(small(), [](RenderOptions& options) { options.system = System::svm; }); }});
  kinds.push_back({"a rank", [] {
                     static nodes::Loopback loopback(1);
                     static nodes::RankLinks links(loopback.rank(0));
                     return changed(small(), [](RenderOptions& options) { options.computer.ranks = &links; });
                   }});
  return kinds;
}

/// A mesh file that is placed, seen and lit by the command line.
RenderOptions staged(const TemporaryFolder& folder) {
  RenderOptions options = small();
  tests::write_text(folder / "a.obj", tests::triangle_obj);
  options.picture.scene = folder / "a.obj";
  options.picture.scene_setup = {.camera = parse_camera("0,0,9/0,0,0/0,1,0"),
                                 .lights = {parse_light("1,2,3")},
                                 .mesh = {.scale = 2, .up = UpAxis{2, true}, .smooth_degrees = 30, .allows_missing = true}};
  return options;
}

}  // namespace

TEST_CASE("the counters of every kind of run are as the schema says, without any figure that it does not know") {
  if (!has_validator()) {
    return;
  }
  const TemporaryFolder folder;
  std::vector<std::string> files;
  const auto add = [&](const std::string& json) {
    files.push_back(folder / (std::to_string(files.size()) + ".json"));
    tests::write_text(files.back(), json);
  };
  for (const Kind& kind : all_kinds()) {
    CAPTURE(std::string(kind.name));
    Rendered rendered(kind.options());
    add(rendered.json());
    clear_counters(*rendered.report);  // as of a frame that is a copy
    RenderRecord copied = rendered.record();
    copied.copied_frame = 1;
    add(stats_json(copied));
  }
  add(Rendered(staged(folder)).json());
  const Rendered rendered(small());
  RenderRecord resumed = rendered.record();
  resumed.samples_found_done = 3;
  add(stats_json(resumed));
  CHECK(faults_by_schema(files) == "");
}

TEST_CASE("the schema has each counter that has a row, in their order, with what the row says of it") {
  const nlohmann::ordered_json schema = nlohmann::ordered_json::parse(stats_schema())["$defs"];
  const auto check = [&](const char* group, const auto& rows) {
    const nlohmann::ordered_json& properties = schema[group]["properties"];
    auto property = properties.begin();
    for (const auto& row : rows) {
      CAPTURE(std::string(row.key));
      REQUIRE(property != properties.end());
      CHECK(property.key() == row.key);
      CHECK(property->value("description", "") == row.help);
      ++property;
    }
    return property == properties.end();
  };
  CHECK(check("hits", hit_counters));
  CHECK(check("operations", counters_of<core::Operations>));
  CHECK(check("work", counters_of<svm::WorkCounters>));
  CHECK(check("questions", counters_of<svm::QuestionCounters>));
  CHECK_FALSE(check("pages", counters_of<svm::PageCounters>));              // and those of a pixel
  CHECK_FALSE(check("movement", counters_of<dataflow::MovementCounters>));  // and bytes
}

TEST_CASE("the schema has each option of strategies in the order of --stats, and each object all its keys and no others") {
  const nlohmann::ordered_json schema = nlohmann::ordered_json::parse(stats_schema());
  const nlohmann::ordered_json& render = schema["$defs"]["render"]["properties"];
  const nlohmann::ordered_json& options = render["options"];
  auto property = options["properties"].find("cache_pages");
  for (const ReportedKey& reported : reported_keys()) {
    REQUIRE(property != options["properties"].end());
    CHECK(property.key() == reported.key);
    ++property;
  }
  CHECK(property == options["properties"].end());
  CHECK(options["required"].size() == options["properties"].size());
  CHECK(render["skips"]["required"].back() == "cutoff");
  CHECK(schema["$defs"]["travel"]["additionalProperties"] == false);
  CHECK(stats_schema().find('*') == std::string::npos);
}

TEST_CASE("a figure that the schema does not know, one that is missing and one of another kind are found, at any depth") {
  if (!has_validator()) {
    return;
  }
  const TemporaryFolder folder;
  const nlohmann::json genuine = nlohmann::json::parse(Rendered(modelled(Strategy::dataflow)).json());
  const std::vector<std::pair<const char*, std::function<void(nlohmann::json&)>>> changes = {
      {"unknown", [](auto& json) { json["unknown"] = 1; }},
      {"unknown", [](auto& json) { json["nodes"][2]["operations"]["unknown"] = 1; }},
      {"unknown", [](auto& json) { json["virtual_seconds"]["waiting"]["unknown"] = 1; }},
      {"unknown", [](auto& json) { json["skips"]["unlit"]["unknown"] = 1; }},
      {"sent", [](auto& json) { json["packets"].erase("sent"); }},
      {"-1", [](auto& json) { json["rays"]["primary"] = -1; }},
      {"film_hash", [](auto& json) { json["film_hash"] = nullptr; }},
      {"format", [](auto& json) { json["format"] = 3; }},
      {"99", [](auto& json) { json["links"]["rows"][0].push_back(99); }},
  };
  for (const auto& [named, change] : changes) {
    nlohmann::json json = genuine;
    change(json);
    tests::write_text(folder / "changed.json", json.dump());
    CAPTURE(std::string(named));
    CHECK(faults_by_schema({folder / "changed.json"}) != "");
  }
}

}  // namespace dmpc::apps::schema_test
