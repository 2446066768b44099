#include "dataflow/distribution.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "dataflow/regions/balance.h"
#include "tests/support/border_scene.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace distribution_test {

using namespace dmpc;
using dataflow::Bsp;
using dataflow::Distribution;
using dataflow::PlanRequest;
using tests::Subject;

namespace {

Bsp equal_regions(const Subject& subject, std::uint32_t node_count) {
  const core::RenderSettings& settings = subject.settings();
  return dataflow::equal_size_bsp(core::grid_size(settings.header.frame), dataflow::axes_facing(settings.camera), node_count);
}

Distribution assigned(const Subject& subject, std::uint32_t node_count) {
  return dataflow::distribute(subject.database(), subject.settings(), equal_regions(subject, node_count));
}

double duplication(const Subject& subject, std::uint32_t node_count) {
  return assigned(subject, node_count).duplication(subject.database());
}

PlanRequest request_of(const Subject& subject, std::uint32_t node_count) {
  return {.shares = assigned(subject, node_count).shares(), .rays = {.ray_batch = 1, .ray_credits = 1}, .width = 8, .height = 8};
}

std::size_t needed_bytes(const Subject& subject, std::uint32_t node_count) {
  return dataflow::smallest_node_memory_bytes(request_of(subject, node_count));
}

std::optional<std::uint32_t> smallest_above(const Subject& subject, std::uint32_t node_count, std::size_t memory_bytes) {
  PlanRequest request = request_of(subject, node_count);
  request.computer.node_memory_bytes = memory_bytes;
  return dataflow::smallest_node_count(request, [&](std::uint32_t count) { return assigned(subject, count).shares(); });
}

}  // namespace

TEST_CASE("every node is assigned the part of its own region, and every primary ray goes to one node") {
  const Subject subject(tests::mirrors_and_glass(), {12, 10, 3});
  Bsp bsp = equal_regions(subject, 5);
  bsp.assign(std::vector<std::uint32_t>{3, 1, 4, 0, 2});
  const Distribution distribution = dataflow::distribute(subject.database(), subject.settings(), bsp);
  std::vector<int> times(std::size_t{12} * 10 * 3);
  REQUIRE(distribution.parts.size() == 5);
  REQUIRE(distribution.primaries.size() == 5);
  for (std::uint32_t node = 0; node < 5; ++node) {
    CHECK(distribution.parts[node].header.region == bsp.region_at(bsp.region_index_of(nodes::NodeId{node})));
    for (const dataflow::PrimaryRun& run : distribution.primaries[node]) {
      for (std::uint64_t number = run.first; number < run.first + run.count; ++number) {
        ++times.at(number);
      }
    }
  }
  CHECK(std::all_of(times.begin(), times.end(), [](int count) { return count == 1; }));
}

TEST_CASE("shares say what each node's part and list of primary rays take") {
  const Subject subject(tests::built_in("teapot-4"), {8, 8});
  const Distribution distribution = assigned(subject, 3);
  const std::vector<dataflow::Share> shares = distribution.shares();
  REQUIRE(shares.size() == 3);
  for (std::size_t node = 0; node < 3; ++node) {
    CHECK(shares[node].part_bytes == distribution.parts[node].record_bytes);
    CHECK(shares[node].primary_runs == distribution.primaries[node].size());
  }
}

TEST_CASE("parts may be measured without being kept") {
  const Subject subject(tests::built_in("teapot-4"), {8, 8});
  const Distribution kept = assigned(subject, 3);
  dataflow::Regions bsp = equal_regions(subject, 3);
  const dataflow::MeasuredParts parts = dataflow::measure_parts(subject.database(), subject.settings(), bsp);
  const auto shares = dataflow::measure_shares(subject.settings(), std::span(&bsp, 1), std::span(&parts, 1));
  REQUIRE(shares.size() == 1);
  REQUIRE(shares[0].size() == 3);
  CHECK(parts.duplication == kept.duplication(subject.database()));
  for (std::size_t node = 0; node < 3; ++node) {
    CHECK(shares[0][node].part_bytes == kept.shares()[node].part_bytes);
    CHECK(shares[0][node].primary_runs == kept.shares()[node].primary_runs);
    CHECK(bsp.is_empty(static_cast<std::uint32_t>(node)) == kept.regions.is_empty(static_cast<std::uint32_t>(node)));
  }
}

TEST_CASE("nothing is held twice by one node, or by nodes whose borders are those of macro cells") {
  const Subject subject(tests::BorderScene().scene(), {4, 4}, tests::BorderScene::options());
  CHECK(duplication(subject, 1) == 1.0);
  CHECK(duplication(subject, 2) == 1.0);
  CHECK(duplication(subject, 4) == 1.0);
}

TEST_CASE("cuts through macro cells have primitives held twice, more of them the more cuts") {
  const Subject subject(tests::built_in("teapot-6"), {4, 4});
  CHECK(duplication(subject, 1) == 1.0);
  CHECK(duplication(subject, 16) > 1.0);
  CHECK(duplication(subject, 64) > duplication(subject, 16));
}

TEST_CASE("a scene without a primitive is assigned all the same") {
  const Subject subject(core::Scene{}, {3, 2});
  const Distribution distribution = assigned(subject, 4);
  CHECK(distribution.duplication(subject.database()) == 1.0);
  std::uint64_t rays = 0;
  for (const auto& runs : distribution.primaries) {
    for (const dataflow::PrimaryRun& run : runs) {
      rays += run.count;
    }
  }
  CHECK(rays == 6);
}

TEST_CASE("the smallest number of nodes that is found fits, and one fewer does not") {
  const Subject subject(tests::built_in("tetra-7"), {8, 8});
  for (const std::uint32_t enough : {2U, 3U, 5U, 8U}) {
    CAPTURE(enough);
    const std::size_t memory_bytes = needed_bytes(subject, enough);
    const auto found = smallest_above(subject, 1, memory_bytes);
    REQUIRE(found);
    CHECK(*found > 1);
    CHECK(*found <= enough);
    CHECK(needed_bytes(subject, *found) <= memory_bytes);
    CHECK(needed_bytes(subject, *found - 1) > memory_bytes);
  }
}

TEST_CASE("only more nodes than were asked for are tried, and none is named where none fits") {
  const Subject subject(tests::built_in("tetra-5"), {8, 8});
  CHECK(*smallest_above(subject, 4, needed_bytes(subject, 1)) == 5);
  CHECK(!smallest_above(subject, 1, std::size_t{200} << 10U));  // less than a thread's stack
}

}  // namespace distribution_test
