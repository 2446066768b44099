// Heat maps: over all pixels they add up to what the run counted, and where they promise so they have the same bits in every run.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "core/picture/heat_kind.h"
#include "core/trace/charge.h"
#include "nodes/observers/heat_map.h"
#include "tests/support/priced_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::heat_test {
namespace {

using core::HeatKind;
using nodes::HeatMap;
using Values = std::vector<std::uint64_t>;

constexpr std::array all_kinds = {HeatKind::faults, HeatKind::references, HeatKind::pages, HeatKind::rays,
                                  HeatKind::time,   HeatKind::node,       HeatKind::depth};
constexpr int side = 12;

/// Mirrors, glass, shadows and some sky; two samples a pixel.
Subject heated() {
  core::BuildOptions options;
  options.page_size_bytes = 512;
  return Subject(core::built_in_scene(core::parse_scene_name("balls-2")),
                 {.width = side, .height = side, .samples = 2, .knows_background = true}, options);
}

HeatMap empty_map(bool with_pages = true) {
  const std::vector<HeatKind> kinds(all_kinds.begin(), all_kinds.end());
  std::vector<HeatKind> fewer = kinds;
  std::erase(fewer, HeatKind::pages);
  return HeatMap(side * side, with_pages ? kinds : fewer);
}

Values values(const HeatMap& map, HeatKind kind) { return {map.values(kind).begin(), map.values(kind).end()}; }

svm::RunOptions small_cache(std::uint32_t node_count) {
  svm::RunOptions options;
  options.computer.node_count = node_count;
  options.pages.cache_pages = 2;
  return options;
}

/// Pixels stay where they are, and one at a time is under way on a node.
svm::RunOptions fixed_order(std::uint32_t node_count) {
  svm::RunOptions options = small_cache(node_count);
  options.pages.work_item_side = 0;
  options.pages.in_flight = 1;
  return options;
}

HeatMap svm_map(const Subject& heated, svm::RunOptions options) {
  HeatMap map = empty_map();
  options.watching.heat = &map;
  CHECK(outcome_of(run_svm(heated, options)) == heated.outcome());
  return map;
}

HeatMap replicated_map(const Subject& heated, svm::RunOptions options) {
  HeatMap map = empty_map(false);
  options.pages.cache_pages = std::nullopt;
  options.watching.heat = &map;
  CHECK(outcome_of(run_replicated(heated, options)) == heated.outcome());
  return map;
}

HeatMap dataflow_map(const Subject& heated, dataflow::RunOptions options) {
  HeatMap map = empty_map(false);
  options.watching.heat = &map;
  CHECK(outcome_of(run_dataflow(heated, options)) == heated.outcome());
  return map;
}

std::uint64_t computing_ns(const nodes::VirtualReport& report) {
  std::uint64_t sum_ns = 0;
  for (std::size_t node = 0; node + 1 < report.nodes.size(); ++node) {  // the host is last
    sum_ns += report.nodes[node].computing_ns;
  }
  return sum_ns;
}

/// Each node's time ends at a whole nanosecond.
void check_time(std::uint64_t sum_ps, std::uint64_t expected_ns, std::uint32_t node_count) {
  CHECK(sum_ps >= expected_ns * 1000);
  CHECK(sum_ps < (expected_ns + node_count) * 1000);
}

}  // namespace

TEST_CASE("over all pixels the heat of pages adds up to the run's counters, with waiting pixels, too") {
  const Subject small = heated();
  for (const std::uint32_t node_count : {1U, 2U, 5U}) {
    HeatMap map = empty_map();
    svm::RunOptions options = small_cache(node_count);
    options.watching.heat = &map;
    const svm::Report report = run_svm(small, options);
    CHECK(map.sum(HeatKind::rays) == report.operations().ray_count());
    CHECK(map.sum(HeatKind::references) == report.pages().references);
    CHECK(map.sum(HeatKind::faults) == report.pages().faults);
    CHECK(map.sum(HeatKind::pages) == report.pages().distinct_pages);
    CHECK(report.pages().distinct_pages > 0);
    CHECK((report.pages().faults > 0) == (node_count > 1));
    CHECK(map.sum(HeatKind::time) > 0);
  }
}

TEST_CASE("in virtual time the pixels' times add up to the nodes' computing") {
  const Subject small = heated();
  HeatMap map = empty_map(false);
  svm::RunOptions options = small_cache(3);
  options.watching.heat = &map;
  options.computer.machine = priced_machine();
  const svm::Report report = run_svm(small, options);
  check_time(map.sum(HeatKind::time), computing_ns(*report.virtual_time), 3);
}

TEST_CASE("where rays travel the pixels' virtual times are all computing but unpacking") {
  const Subject small = heated();
  HeatMap map = empty_map(false);
  dataflow::RunOptions options{.computer = {.node_count = 3, .machine = priced_machine()}, .watching = {.heat = &map}};
  const dataflow::Report report = run_dataflow(small, options);
  std::uint64_t unpacked = 0;
  for (const std::uint64_t rays : report.rays().in) {
    unpacked += rays;
  }
  CHECK(unpacked > 0);
  CHECK(map.sum(HeatKind::rays) == report.operations().ray_count());
  const std::uint64_t packing_ps = options.computer.machine->cost_ps[static_cast<std::size_t>(core::Charge::ray_packing)];
  check_time(map.sum(HeatKind::time) + unpacked * packing_ps, computing_ns(*report.virtual_time), 3);
}

TEST_CASE("rays and depths of a pixel are the same for every strategy and number of nodes") {
  const Subject small = heated();
  const HeatMap one = svm_map(small, small_cache(1));
  CHECK(values(one, HeatKind::depth).size() == side * side);
  for (const std::uint32_t node_count : {2U, 5U}) {
    const dataflow::RunOptions rays{.computer = {.node_count = node_count}};
    for (const HeatMap& map :
         {svm_map(small, small_cache(node_count)), replicated_map(small, small_cache(node_count)), dataflow_map(small, rays)}) {
      CHECK(values(map, HeatKind::rays) == values(one, HeatKind::rays));
      CHECK(values(map, HeatKind::depth) == values(one, HeatKind::depth));
    }
  }
}

TEST_CASE("references and distinct pages of a pixel are the same for every number of nodes and schedule") {
  const Subject small = heated();
  const HeatMap one = svm_map(small, small_cache(1));
  svm::RunOptions disturbed = small_cache(5);
  disturbed.computer.chaos = nodes::chaos_of(7);
  for (const svm::RunOptions& options : {small_cache(2), small_cache(5), disturbed}) {
    const HeatMap map = svm_map(small, options);
    CHECK(values(map, HeatKind::references) == values(one, HeatKind::references));
    CHECK(values(map, HeatKind::pages) == values(one, HeatKind::pages));
  }
}

TEST_CASE("with pixels that stay and wait alone, threads and virtual time fault for the same pixels on the same nodes") {
  const Subject small = heated();
  svm::RunOptions modelled = fixed_order(4);
  modelled.computer.machine = priced_machine();
  const HeatMap threads = svm_map(small, fixed_order(4)), virtually = svm_map(small, modelled);
  CHECK(values(threads, HeatKind::faults) == values(virtually, HeatKind::faults));
  CHECK(values(threads, HeatKind::node) == values(virtually, HeatKind::node));
  CHECK(threads.sum(HeatKind::faults) > 0);
}

TEST_CASE("where rays travel a pixel's node is the same in every run") {
  const Subject small = heated();
  const dataflow::RunOptions calm{.computer = {.node_count = 4}};
  dataflow::RunOptions disturbed = calm;
  disturbed.computer.chaos = nodes::chaos_of(5);
  const Values nodes = values(dataflow_map(small, calm), HeatKind::node);
  CHECK(nodes == values(dataflow_map(small, disturbed), HeatKind::node));
  CHECK(*std::max_element(nodes.begin(), nodes.end()) > 0);
}

TEST_CASE("a refined picture's heat is that of all its passes") {
  const Subject refined(core::built_in_scene(core::parse_scene_name("balls-2")),
                        {.width = side, .height = side, .samples = 2, .refinement = {.error = 0.02, .samples_max = 8}});
  HeatMap pages = empty_map(false), rays = empty_map(false);
  svm::RunOptions options = small_cache(3);
  options.watching.heat = &pages;
  const svm::Report report = run_svm(refined, options);
  static_cast<void>(run_dataflow(refined, {.computer = {.node_count = 3}, .watching = {.heat = &rays}}));
  CHECK(report.refinement.passes > 1);
  CHECK(pages.sum(HeatKind::rays) == report.operations().ray_count());
  CHECK(values(pages, HeatKind::rays) == values(rays, HeatKind::rays));
  CHECK(values(pages, HeatKind::depth) == values(rays, HeatKind::depth));
}

TEST_CASE("a heat map of another size than the picture's is an error") {
  const Subject small = heated();
  HeatMap map(side * side - 1, all_kinds);
  svm::RunOptions options = small_cache(2);
  options.watching.heat = &map;
  CHECK_THROWS_AS(run_svm(small, options), core::InternalError);
  CHECK_THROWS_AS(run_dataflow(small, {.computer = {.node_count = 2}, .watching = {.heat = &map}}), core::InternalError);
}

}  // namespace dmpc::tests::heat_test
