#include "dataflow/regions/scattered.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/expect.h"
#include "dataflow/regions/regions.h"
#include "nodes/topology.h"
#include "tests/support/complaint.h"

namespace scattered_test {

using namespace dmpc;
using dataflow::Scattered;
using dataflow::scattered_shape;

namespace {

constexpr core::Corner cube{1024, 512, 1024};

Scattered scattered(std::uint32_t node_count, std::uint32_t regions_a_node) {
  return dataflow::scatter(cube, {0, 2}, node_count, regions_a_node);
}

std::uint32_t owner_at(const Scattered& lattice, std::uint32_t x, std::uint32_t y) {
  return nodes::index_of(lattice.owner_at(y * lattice.shape().count[0] + x));
}

constexpr std::uint32_t node_counts[] = {1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 16, 31, 36, 64, 100, 128};
constexpr std::uint32_t regions_of_each[] = {1, 2, 3, 4, 5, 16};

}  // namespace

TEST_CASE("scattered: every node has as many regions as was asked for") {
  for (const std::uint32_t node_count : node_counts) {
    for (const std::uint32_t regions : regions_of_each) {
      CAPTURE(node_count);
      CAPTURE(regions);
      const auto by_node = dataflow::Regions(scattered(node_count, regions)).by_node();
      REQUIRE(by_node.size() == node_count);
      CHECK(std::all_of(by_node.begin(), by_node.end(), [&](const auto& own) { return own.size() == regions; }));
    }
  }
}

TEST_CASE("scattered: neighbours along either axis belong to different nodes") {
  for (const std::uint32_t node_count : node_counts) {
    for (const std::uint32_t regions : regions_of_each) {
      CAPTURE(node_count);
      CAPTURE(regions);
      const Scattered lattice = scattered(node_count, regions);
      const auto [columns, rows] = lattice.shape().count;
      std::uint32_t alike = 0;
      for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
          alike += x + 1 < columns && owner_at(lattice, x, y) == owner_at(lattice, x + 1, y) ? 1 : 0;
          alike += y + 1 < rows && owner_at(lattice, x, y) == owner_at(lattice, x, y + 1) ? 1 : 0;
        }
      }
      CHECK((alike == 0) == (node_count > 1 || regions == 1));
    }
  }
}

TEST_CASE("scattered: of 64, 100 or 128 nodes no neighbours are adjacent on a torus, too") {
  for (const std::uint32_t node_count : {64U, 100U, 128U}) {
    CAPTURE(node_count);
    const Scattered lattice = scattered(node_count, 4);
    const nodes::Topology torus(nodes::TopologyKind::torus, node_count);
    const auto [columns, rows] = lattice.shape().count;
    std::uint32_t nearest = 1000;
    for (std::uint32_t y = 0; y + 1 < rows; ++y) {
      for (std::uint32_t x = 0; x + 1 < columns; ++x) {
        const nodes::NodeId here{owner_at(lattice, x, y)};
        nearest = std::min({nearest, torus.hops(here, nodes::NodeId{owner_at(lattice, x + 1, y)}),
                            torus.hops(here, nodes::NodeId{owner_at(lattice, x, y + 1)})});
      }
    }
    CHECK(nearest >= 2);
  }
}

TEST_CASE("scattered: regions are half-open boxes, as near to cubes as may be, that hold every finest cell once") {
  const Scattered lattice = dataflow::scatter({37, 5, 23}, {0, 2}, 6, 4);
  CHECK(lattice.region_count() == 24);
  std::int64_t cells = 0;
  for (std::uint32_t index = 0; index < lattice.region_count(); ++index) {
    const core::Region box = lattice.region_at(index);
    CHECK(box.low[1] == 0);
    CHECK(box.high[1] == 5);
    cells += std::int64_t{box.high[0] - box.low[0]} * (box.high[2] - box.low[2]);
    for (std::int32_t x = box.low[0]; x < box.high[0]; ++x) {
      for (std::int32_t z = box.low[2]; z < box.high[2]; ++z) {
        REQUIRE(lattice.region_index_of({x, 3, z}) == index);
      }
    }
  }
  CHECK(cells == 37 * 23);
  CHECK(scattered(64, 1).shape().count == std::array<std::uint32_t, 2>{8, 8});
  CHECK(scattered(64, 16).shape().count == std::array<std::uint32_t, 2>{32, 32});
  CHECK(scattered_shape({1600, 100}, 16, 1)->count == std::array<std::uint32_t, 2>{16, 1});
  CHECK(scattered_shape({100, 1600}, 16, 1)->count == std::array<std::uint32_t, 2>{1, 16});
}

TEST_CASE("scattered: one node has all regions, and as many regions as finest columns are not too many") {
  CHECK(scattered(1, 16).shape().step == std::array<std::uint32_t, 2>{0, 0});
  const Scattered finest = dataflow::scatter({4, 9, 4}, {0, 2}, 4, 4);
  CHECK(finest.region_count() == 16);
  CHECK(finest.region_at(5) == core::Region{{1, 0, 1}, {2, 9, 2}});
}

TEST_CASE("scattered: too many regions are refused with what there may be") {
  CHECK(tests::complaint_of<core::UsageError>([] { scattered(64, 1025); }) ==
        "1025 regions a node on 64 nodes are too many: all nodes together can have 65536 regions, so each of these 1024");
  CHECK(tests::complaint_of<core::UsageError>([] {
          dataflow::scatter({4, 9, 4}, {0, 2}, 4, 5);
        }) == "5 regions a node on 4 nodes are too many: the grid has 4x4 finest columns, and each region needs one");
}

}  // namespace scattered_test
