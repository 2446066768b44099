#include "apps/show/stats/stats.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/apps/show/rendered.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::stats_test {

using tests::TemporaryFolder;

TEST_CASE("the keys of the counters are an interface") {
  const std::string json = Rendered(small()).json();
  CHECK(keys(json, 1) == std::vector<std::string>{"format",       "program",    "options",   "runner",         "machine",
                                                  "film_hash",    "film_scale", "sampling",  "rays",           "hits",
                                                  "operations",   "seconds",    "run_hash",  "machine_digest", "virtual_seconds",
                                                  "time_percent", "events",     "links",     "database",       "packets",
                                                  "pages",        "work",       "questions", "travel",         "load",
                                                  "regions",      "mapping",    "pairs",     "sandbox",        "chaos",
                                                  "skips",        "heat_maps",  "nodes",     "ranks",          "host"});
  for (const std::string& key : words_between(
           "samples_per_pixel passes estimated_error cutoff rays_cut mean_error_bound primary reflected refracted shadow "
           "scattered total secondary shadow_blocked total_internal_reflections load build render write user system bytes "
           "pages page_size primitives dropped collapsed references hits faults evictions distinct_per_pixel sent received "
           "overflow memory busy idle scene width node_memory home_pages reserve page_request",
           ' ')) {
    CHECK_MESSAGE(contains(json, "\"" + key + "\""), key);
  }
}

TEST_CASE("the counters agree with the report") {
  const Rendered rendered(small());
  const std::string json = rendered.json();
  CHECK(value(json, "film_hash") == "\"" + hash_text(account_of(*rendered.report).film.hash()) + "\"");
  CHECK(value(json, "primary") == "192");
  CHECK(value(json, "scene") == "\"balls-1\"");
  CHECK(value(json, "width") == "16");
  CHECK(value(json, "nodes") == "3");
  CHECK(value(json, "load") == "0.5");
  CHECK(value(json, "sent") == value(json, "received"));
  CHECK(value(json, "distinct_per_pixel") == "null");
}

TEST_CASE("how the scene is placed, seen and lit is told where the command line says it") {
  RenderOptions options = small();
  const std::string plain = Rendered(options).json();
  for (const char* const key : {"camera", "light", "scale", "up", "smooth", "missing"}) {
    CHECK_MESSAGE(value(plain, key) == "null", key);
  }
  const TemporaryFolder folder;
  tests::write_text(folder / "a.obj", tests::triangle_obj);
  options.picture.scene = folder / "a.obj";
  options.picture.scene_setup = {.camera = parse_camera("0,0,9/0,0,0/0,1,0"),
                                 .lights = {parse_light("1,2,3"), parse_light("4,5,6/1,1,1")},
                                 .mesh = {.scale = 2, .up = UpAxis{2, true}, .smooth_degrees = 30, .allows_missing = true}};
  const auto reported = nlohmann::json::parse(Rendered(options).json())["options"];
  CHECK(reported["camera"] == "0,0,9/0,0,0/0,1,0");
  CHECK(reported["light"] == nlohmann::json({"1,2,3", "4,5,6/1,1,1"}));
  CHECK(reported["scale"] == 2);
  CHECK(reported["up"] == "-z");
  CHECK(reported["smooth"] == 30);
  CHECK(reported["missing"] == "plain");
}

TEST_CASE("every node has an entry of its own") { CHECK(tests::count(Rendered(small()).json(), "\"quanta\"") == 3); }

TEST_CASE("distinct pages are counted on demand") {
  RenderOptions options = small();
  options.pages.count_pages = true;
  const std::string counted = value(Rendered(options).json(), "distinct_per_pixel");
  CHECK(std::stod(counted) >= 1);
}

TEST_CASE("chaos is told by its seed and what it did, and only where there was some") {
  CHECK(value(Rendered(small()).json(), "chaos") == "null");
  RenderOptions options = small();
  options.computer.chaos = nodes::Chaos{.seed = ~std::uint64_t{0}, .held_percent = 100};
  const std::string json = Rendered(options).json();
  CHECK(value(json, "seed") == "18446744073709551615");
  CHECK(std::stoi(value(json, "packets_delayed")) > 0);
  CHECK(value(json, "quanta_sat_out") == "0");
}

TEST_CASE("a node's time is what it computed, slept and waited for a core") {
  Rendered rendered(small());
  nodes::NodeCounters& counters = std::get<svm::Report>(*rendered.report).nodes[0].counters;
  counters.busy_ns = 2'000'000'000;
  counters.asleep_ns = 3'000'000'000;
  counters.wall_ns = 9'000'000'000;
  std::string json = rendered.json();
  CHECK(value(json, "busy") == "2.0");
  CHECK(value(json, "idle") == "3.0");
  CHECK(value(json, "waiting") == "4.0");
  CHECK(value(json, "wall") == "9.0");
  counters.wall_ns = 4'999'999'999;
  json = rendered.json();
  CHECK(value(json, "waiting") == "0.0");
}

TEST_CASE("sums that saturate on the host's film are told") {
  Rendered rendered(small());
  std::get<svm::Report>(*rendered.report).host_deposits_saturated = 4711;
  CHECK(contains(rendered.json(), "\"deposits_saturated\": 4711"));
}

TEST_CASE("of a picture that was gone on with, what its earlier samples would have to tell is null") {
  const Rendered rendered(small());
  RenderRecord record = rendered.record();
  record.samples_found_done = 3;
  const std::string json = stats_json(record);
  CHECK(value(json, "mean_error_bound") == "null");
  CHECK(value(json, "deposits_saturated") == "null");
  CHECK(value(rendered.json(), "mean_error_bound") != "null");
}

TEST_CASE("what belongs to another strategy is null") {
  const std::string pages = Rendered(small()).json(), copies = Rendered(small(Strategy::replicated)).json(),
                    rays = Rendered(small(Strategy::dataflow)).json();
  for (const std::string key : {"travel", "load", "regions", "mapping", "pairs", "ray_batch", "topology", "token_rounds"}) {
    CAPTURE(key);
    CHECK(value(pages.substr(key == "load" ? pages.find("\"work\"") : 0), key) == "null");
    CHECK(value(rays.substr(key == "load" ? rays.find("\"travel\"") : 0), key) != "null");
  }
  for (const std::string key : {"pages", "work", "in_flight", "work_item", "count_pages"}) {
    CAPTURE(key);
    CHECK(value(rays.substr(key == "pages" ? rays.find("\"by_kind\"") : 0), key) == "null");
    CHECK(value(copies.substr(key == "pages" ? copies.find("\"by_kind\"") : 0), key) != "null");
  }
  CHECK(value(copies, "cache_pages") == "null");
  CHECK(value(pages, "cache_pages") != "null");
  CHECK(value(copies, "replacement") == "null");
  CHECK(value(pages.substr(pages.find("\"work\"")), "questions") == "null");
  const std::string questions = Rendered(small(Strategy::forest)).json();
  CHECK(value(questions, "rays_asked") != "null");
  CHECK(value(questions, "structure") == "\"extents\"");
  CHECK(value(pages, "structure") == "\"grid\"");
}

TEST_CASE("every strategy has the same keys") {
  const auto all_keys = [](Strategy strategy) {
    const std::string json = Rendered(small(strategy)).json();
    return std::pair(keys(json, 1), keys(json.substr(0, json.find("\"film_hash\"")), 2));
  };
  CHECK(all_keys(Strategy::dataflow) == all_keys(Strategy::svm));
  CHECK(all_keys(Strategy::dataflow) == all_keys(Strategy::replicated));
  CHECK(all_keys(Strategy::dataflow) == all_keys(Strategy::forest));
}

TEST_CASE("the strategy is told") {
  CHECK(value(Rendered(small(Strategy::dataflow)).json(), "strategy") == "\"dataflow\"");
  CHECK(value(Rendered(small(Strategy::replicated)).json(), "strategy") == "\"replicated\"");
}

TEST_CASE("what was left out is told skip by skip, with its unit, and whether it was on") {
  RenderOptions options = small(Strategy::dataflow);
  options.picture.skips.unlit = false;
  const Rendered rendered(options);
  const std::string json = rendered.json(), skips = json.substr(json.find("\"skips\""));
  const auto of = [&](const std::string& name) { return skips.substr(skips.find("\"" + name + "\"")); };
  CHECK(value(of("unlit"), "on") == "false");
  CHECK(value(of("unlit"), "avoided") == "0");
  CHECK(value(of("unlit"), "unit") == "\"shadow rays\"");
  for (const core::Skip& skip : core::all_skips) {
    std::string name = skip.name;
    std::replace(name.begin(), name.end(), '-', '_');
    CAPTURE(name);
    CHECK(value(of(name), "exact") == "true");
    CHECK(value(of(name), "avoided") == std::to_string(account_of(*rendered.report).operations.skipped.*skip.avoided));
  }
  CHECK(value(of("zero_terms"), "on") == "true");
  CHECK(value(of("zero_terms"), "avoided") != "0");
  CHECK(value(of("cutoff"), "on") == "false");
  CHECK(value(of("cutoff"), "exact") == "false");
}

TEST_CASE("a picture that is a copy has its film, and nothing that a run counts") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::forest}) {
    Rendered rendered(small(strategy));
    const std::string before = rendered.json();
    clear_counters(*rendered.report);
    RenderRecord copied = rendered.record();
    copied.copied_frame = 7;
    const std::string json = stats_json(copied);
    CHECK(value(json, "film_hash") == value(before, "film_hash"));
    CHECK(value(before, "total") != "0");
    CHECK(value(json, "total") == "0");
    CHECK(value(before, "copied_frame") == "null");
    CHECK(value(json, "copied_frame") == "7");
    const Account account = account_of(*rendered.report);
    CHECK(nodes::total(account.sent).packets + account.operations.bvh_node_reads + nodes::total(account.host.received).packets ==
          0);
  }
}

TEST_CASE("the records of the database are told by kind") {
  const Rendered rendered(small());
  const std::string json = rendered.json();
  CHECK(value(json, "bvh_nodes") == std::to_string(rendered.database.records().bvh_nodes));
  CHECK(value(json, "sphere_leaves") != "0");
  CHECK(value(json, "cone_leaves") == "0");
  CHECK(value(json, "voxel_references") == "0");
  RenderOptions with_voxels = small();
  with_voxels.database.build.structure = core::Structure::voxels;
  const Rendered on_voxels(with_voxels);
  CHECK(on_voxels.database.records().voxel_references > 0);
  CHECK(value(on_voxels.json(), "voxel_references") == std::to_string(on_voxels.database.records().voxel_references));
  CHECK(value(json, "normals") == "0");
  CHECK(value(json, "normal_reads") == "0");
  CHECK(value(json, "lights") == "3");
}

TEST_CASE("a hash is sixteen digits") {
  CHECK(hash_text(0) == "0000000000000000");
  CHECK(hash_text(0xfedcba9876543210ULL) == "fedcba9876543210");
}

}  // namespace dmpc::apps::stats_test
