#include "apps/stats.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "apps/load_scene.h"
#include "apps/run_strategy.h"
#include "apps/summary.h"

namespace dmpc::apps {

namespace {

/// One small render and what is said about it.
struct Rendered {
  explicit Rendered(RenderOptions given) : options(std::move(given)) {
    const core::Scene scene = load_scene(options.picture.scene);
    database = core::build_database(scene, {.page_size_bytes = options.page_size_bytes});
    const core::RenderSettings settings = render_settings(options.picture, scene, database);
    report = make_ready(options, database, settings).start({}, {});
  }
  RenderRecord record() const { return {options, database, *report, {.load = 0.5, .prepare = 0.25, .render = 2, .user = 1}}; }
  std::string json() const { return stats_json(record()); }

  RenderOptions options;
  core::Database database;
  std::optional<Report> report;
};

RenderOptions small(Strategy strategy = Strategy::svm) {
  RenderOptions options;
  options.picture.scene = "balls-1";
  options.picture.resolution = {16, 12};
  options.strategy = strategy;
  options.computer.node_count = 3;
  return options;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What stands behind the first `"key": `, up to the line's end.
std::string value(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": ");
  const std::size_t begin = at + key.size() + 4;
  return at == std::string::npos ? "missing" : json.substr(begin, json.find_first_of(",\n", begin) - begin);
}

/// Keys that stand `depth` levels deep, in order.
std::vector<std::string> keys(const std::string& json, std::size_t depth) {
  std::vector<std::string> found;
  std::istringstream lines(json);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 2 * depth && line.find_first_not_of(' ') == 2 * depth && line[2 * depth] == '"') {
      found.push_back(line.substr(2 * depth + 1, line.find('"', 2 * depth + 1) - 2 * depth - 1));
    }
  }
  return found;
}

}  // namespace

TEST_CASE("the keys of the counters are an interface") {
  const std::string json = Rendered(small()).json();
  CHECK(keys(json, 1) == std::vector<std::string>{"program",  "options", "film_hash", "rays",  "hits",   "operations", "seconds",
                                                  "database", "packets", "pages",     "work",  "travel", "load",       "regions",
                                                  "mapping",  "pairs",   "chaos",     "skips", "nodes",  "host"});
  for (const std::string key : {"primary",     "reflected",  "refracted",      "shadow",
                                "total",       "secondary",  "shadow_blocked", "total_internal_reflections",
                                "load",        "build",      "render",         "write",
                                "user",        "system",     "bytes",          "pages",
                                "page_size",   "primitives", "dropped",        "references",
                                "hits",        "faults",     "evictions",      "distinct_per_pixel",
                                "sent",        "received",   "overflow",       "memory",
                                "busy",        "idle",       "scene",          "width",
                                "node_memory", "home_pages", "reserve",        "page_request"}) {
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

TEST_CASE("every node has an entry of its own") {
  const std::string json = Rendered(small()).json();
  std::size_t count = 0;
  for (std::size_t at = json.find("\"quanta\""); at != std::string::npos; at = json.find("\"quanta\"", at + 1)) {
    ++count;
  }
  CHECK(count == 3);
}

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
  CHECK(std::stoi(value(json, "packets_held")) > 0);
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

TEST_CASE("what was left out is told in good grammar") {
  CHECK(dropped_text(0).empty());
  CHECK(dropped_text(1) == "1 degenerate primitive was left out");
  CHECK(dropped_text(2) == "2 degenerate primitives were left out");
}

TEST_CASE("replicated has no cache to speak of") {
  const Rendered rendered(small(Strategy::replicated));
  CHECK(value(rendered.json(), "cache_pages") == "null");
  CHECK(value(rendered.json(), "strategy") == "\"replicated\"");
  std::ostringstream summary;
  print_summary(summary, rendered.record());
  CHECK_FALSE(contains(summary.str(), "pages    "));
}

TEST_CASE("a hash is sixteen digits") {
  CHECK(hash_text(0) == "0000000000000000");
  CHECK(hash_text(0xfedcba9876543210ULL) == "fedcba9876543210");
}

TEST_CASE("the closing lines name scene, computer, memory, rays, pages, times and picture") {
  std::ostringstream output;
  print_summary(output, Rendered(small()).record());
  for (const std::string part :
       {"scene    balls-1, ", "computer 3 nodes, svm, ", "memory   ", "home pages ", "rays     ", "(primary 192, ", "pages    ",
        " look-ups: at home ", "time     load 0.500 s", "picture  ", "16x12"}) {
    CHECK_MESSAGE(contains(output.str(), part), part);
  }
}

}  // namespace dmpc::apps
