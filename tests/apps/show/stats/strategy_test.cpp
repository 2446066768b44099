#include "apps/show/stats/strategy.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>
#include <variant>
#include <vector>

#include "tests/apps/show/rendered.h"

namespace dmpc::apps::strategy_test {

namespace {

StrategyStats stats_of(const Rendered& rendered) {
  return std::visit([&](const auto& report) { return strategy_stats(rendered.options, report); }, *rendered.report);
}

StrategyStats stats_of(const RenderOptions& options) { return stats_of(Rendered(options)); }

/// What --stats says of the options.
Json reported_options_of(const RenderOptions& options) { return Json::parse(Rendered(options).json()).at("options"); }

/// The sum of what stands at `path` in every node's object.
std::uint64_t sum_over_nodes(const StrategyStats& stats, const char* path) {
  const Json::json_pointer pointer(path);
  return std::accumulate(stats.nodes.begin(), stats.nodes.end(), std::uint64_t{0},
                         [&](std::uint64_t sum, const Json& node) { return sum + node.at(pointer).get<std::uint64_t>(); });
}

std::uint64_t at(const Json& json, const char* path) { return json.at(Json::json_pointer(path)).get<std::uint64_t>(); }

}  // namespace

TEST_CASE("what dataflow counts in all is the sum over its nodes") {
  const StrategyStats stats = stats_of(small(Strategy::dataflow));
  REQUIRE(stats.nodes.size() == 3);
  for (const char* path : {"/travel/rays_in/shadow", "/travel/rays_out/total", "/travel/packets", "/travel/packets_flushed",
                           "/travel/overflow/rays", "/travel/hits_sent_back", "/load/work_ps"}) {
    CAPTURE(std::string(path));
    CHECK(at(stats.all, path) == sum_over_nodes(stats, path));
  }
  CHECK(at(stats.all, "/regions/part_bytes") == sum_over_nodes(stats, "/region/part_bytes"));
  CHECK(at(stats.all, "/regions/primitive_copies") == sum_over_nodes(stats, "/region/primitive_copies"));
  CHECK(at(stats.all, "/regions/primary_rays") == 192);
  CHECK(sum_over_nodes(stats, "/region/primary_rays") == 192);
}

TEST_CASE("rays travel between the nodes of dataflow, and each pair's are counted once") {
  const StrategyStats stats = stats_of(small(Strategy::dataflow));
  const Json& pairs = stats.all["pairs"];
  std::vector<std::uint64_t> out(3), in(3);
  std::uint64_t packets = 0, overflowed = 0;
  for (const Json& row : pairs["rows"]) {
    REQUIRE(row.size() == pairs["columns"].size());
    const auto cells = row.get<std::vector<std::uint64_t>>();
    CHECK(cells[0] != cells[1]);
    const std::uint64_t rays = std::accumulate(cells.begin() + 2, cells.begin() + 6, std::uint64_t{0});
    out[cells[0]] += rays;
    in[cells[1]] += rays;
    packets += cells[6];
    overflowed += cells[7];
  }
  CHECK(at(stats.all, "/travel/rays_out/total") > 0);
  CHECK(at(stats.all, "/travel/packets") == packets);
  CHECK(at(stats.all, "/travel/overflow/rays") == overflowed);
  for (std::size_t node = 0; node < 3; ++node) {
    CHECK(out[node] == at(stats.nodes[node], "/travel/rays_out/total"));
    CHECK(in[node] == at(stats.nodes[node], "/travel/rays_in/total"));
  }
}

TEST_CASE("the regions of dataflow share the whole grid out") {
  double share = 0;
  for (const Json& node : stats_of(small(Strategy::dataflow)).nodes) {
    share += node["region"]["share"].get<double>();
    CHECK(node["region"]["low"].size() == 3);
    CHECK(node["region"]["high"].size() == 3);
  }
  CHECK(share == doctest::Approx(1));
}

TEST_CASE("loads are predicted where there was a subsampled picture") {
  RenderOptions options = small(Strategy::dataflow);
  const StrategyStats subsampled = stats_of(options);
  CHECK(subsampled.all["load"]["predicted_ps"] == sum_over_nodes(subsampled, "/load/predicted_ps"));
  CHECK(subsampled.all["load"]["average_predicted"] <= 1);
  CHECK(subsampled.all["load"]["average"] <= 1);
  options.rays.balance.balance = dataflow::Balance::equal_size;
  const StrategyStats equal = stats_of(options);
  CHECK(equal.all["load"]["predicted_ps"].is_null());
  CHECK(equal.all["load"]["average_predicted"].is_null());
  CHECK(equal.nodes[0]["load"]["predicted_ps"].is_null());
  const Json reported = reported_options_of(options);
  CHECK(reported["balance"] == "equal-size");
  CHECK(reported["cuts"] == "longer-side");
  CHECK(reported["backpressure"] == true);
}

TEST_CASE("regions that are scattered have a count and no order of cuts, and together all of the grid") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays.balance = {.balance = dataflow::Balance::scattered, .regions_a_node = 3};
  const StrategyStats stats = stats_of(options);
  const Json reported = reported_options_of(options);
  CHECK(reported["balance"] == "scattered");
  CHECK(reported["regions_a_node"] == 3);
  CHECK(reported["cuts"].is_null());
  double share = 0;
  for (const Json& node : stats.nodes) {
    CHECK(node["region"]["regions"] == 3);
    share += node["region"]["share"].get<double>();
  }
  CHECK(share == doctest::Approx(1));
}

TEST_CASE("regions that move tell of their units, asks and bytes, others of none") {
  RenderOptions options = small(Strategy::dataflow);
  CHECK(stats_of(options).all["travel"]["movement"].is_null());
  options.rays.balance = {.balance = dataflow::Balance::moving, .regions_a_node = 4};
  const StrategyStats stats = stats_of(options);
  const Json reported = reported_options_of(options);
  CHECK(reported["balance"] == "moving");
  CHECK(reported["cuts"] == "longer-side");
  CHECK(at(stats.all, "/travel/movement/units") == 4 * stats.nodes.size());
  for (const char* const figure : {"units", "units_given", "units_taken", "asks", "refusals", "pages_sent", "pages_installed",
                                   "records_walked", "primary_rays_given", "primary_rays_taken", "rays_sent_on", "bytes"}) {
    const std::string place = std::string("/travel/movement/") + figure;
    CAPTURE(place);
    CHECK(at(stats.all, place.c_str()) == sum_over_nodes(stats, place.c_str()));
  }
  CHECK(at(stats.all, "/travel/movement/units_given") == at(stats.all, "/travel/movement/units_taken"));
}

TEST_CASE("without credits all rays go by way of the host, which keeps them") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays.ray_credits = 0;
  const StrategyStats stats = stats_of(options);
  CHECK(stats.all["travel"]["overflow"]["share"] == 1.0);
  CHECK(at(stats.all, "/travel/overflow/rays") == at(stats.all, "/travel/rays_out/total"));
  CHECK(stats.packets_overflowed == at(stats.all, "/travel/packets"));
  CHECK(at(stats.host, "/rays_buffered_max") > 0);
  CHECK(at(stats.host, "/buffered_bytes_max") > at(stats.host, "/rays_buffered_max"));
  CHECK(reported_options_of(options)["ray_credits"] == 0);
}

TEST_CASE("one node sends no ray to another") {
  RenderOptions options = small(Strategy::dataflow);
  options.computer.node_count = 1;
  const Json all = stats_of(options).all;
  CHECK(at(all, "/travel/packets") == 0);
  CHECK(all["travel"]["messages_per_ray"] == 0.0);
  CHECK(all["travel"]["mean_fill"] == 1.0);
  CHECK(all["travel"]["overflow"]["share"] == 0.0);
  CHECK(all["mapping"]["mean_hops"] == 0.0);
  CHECK(all["load"]["average"] == 1.0);
}

TEST_CASE("the fill of packets and the hops of rays are means") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays.ray_batch = 1;
  options.rays.topology = nodes::TopologyKind::crossbar;
  const StrategyStats stats = stats_of(options);
  CHECK(stats.all["travel"]["mean_fill"] == 1.0);
  CHECK(at(stats.all, "/travel/packets") == at(stats.all, "/travel/rays_out/total"));
  CHECK(stats.all["mapping"] == Json{{"topology", "crossbar"}, {"mean_hops", 1.0}, {"mean_hops_random", 1.0}});
}

TEST_CASE("questions of forest are counted by node, and as many are answered as asked") {
  const StrategyStats stats = stats_of(small(Strategy::forest));
  for (const char* path : {"/questions/rays_asked", "/questions/records_asked", "/questions/answers"}) {
    CAPTURE(std::string(path));
    CHECK(at(stats.all, path) > 0);
    CHECK(at(stats.all, path) == sum_over_nodes(stats, path));
  }
  CHECK(at(stats.all, "/questions/rays_asked") == at(stats.all, "/questions/rays_answered"));
  CHECK(at(stats.all, "/questions/records_asked") == at(stats.all, "/questions/records_answered"));
  CHECK_FALSE(stats_of(small()).all.contains("questions"));
}

TEST_CASE("pages and work of svm are counted by node, and a cache has svm alone") {
  const StrategyStats stats = stats_of(small());
  CHECK(at(stats.all, "/pages/faults") == sum_over_nodes(stats, "/pages/faults"));
  CHECK(at(stats.all, "/work/pixels") == 192);
  const Json reported = reported_options_of(small()), replicated = reported_options_of(small(Strategy::replicated));
  CHECK(reported.at("cache_pages") > 0);
  CHECK(reported.at("replacement") == "lru");
  CHECK(replicated.at("cache_pages").is_null());
  CHECK(replicated.at("replacement").is_null());
  CHECK(stats.packets_overflowed == 0);
}

}  // namespace dmpc::apps::strategy_test
