#include "dataflow/regions/bsp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "apps/lab/bench/stability/random.h"

namespace dmpc::tests::bsp_test {

namespace {

using apps::Random;
using core::Corner;
using dataflow::Boundary;
using dataflow::Bsp;
using dataflow::ColumnLattice;
using dataflow::ColumnLoads;
using dataflow::CutAxes;
using dataflow::CutOrder;

constexpr Corner small_grid{128, 64, 192};
constexpr CutAxes axes_xz{0, 2};

/// Loads over the small grid's x and z: `load(i, j)` in the column at (i, j).
template <class Load>
ColumnLoads loads_of(Load load, std::int32_t side = 64, const Corner& grid = small_grid) {
  ColumnLoads loads{ColumnLattice(grid, axes_xz, side)};
  for (std::int32_t j = 0; j < loads.lattice.count(1); ++j) {
    for (std::int32_t i = 0; i < loads.lattice.count(0); ++i) {
      loads.load[loads.lattice.number(i, j)] = static_cast<std::uint64_t>(load(i, j));
    }
  }
  return loads;
}

/// A hill of load: high in one corner, hardly anything elsewhere.
ColumnLoads hill() {
  return loads_of([](int i, int j) { return 3 + 40000 / (1 + (i - 10) * (i - 10) + (j - 20) * (j - 20)); });
}

std::int64_t volume(const core::Region& region) {
  std::int64_t product = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    product *= region.high[axis] - region.low[axis];
  }
  return product;
}

/// Whether every finest column lies in exactly the region that its owner answers for, and the regions are as large as the grid.
bool tiles(const Bsp& bsp) {
  const Corner& size = bsp.grid_size();
  std::int64_t sum = 0;
  for (std::uint32_t region = 0; region < bsp.region_count(); ++region) {
    sum += volume(bsp.region_at(region));
  }
  bool is_right = sum == std::int64_t{size[0]} * size[1] * size[2];
  for (std::int32_t x = 0; x < size[0]; ++x) {
    for (std::int32_t z = 0; z < size[2]; ++z) {
      is_right = is_right && bsp.region_at(bsp.region_index_of(bsp.owner_of({x, 3, z}))).contains(Corner{x, 3, z});
      const dataflow::FoundRegion found = bsp.find({x, 3, z});
      is_right = is_right && found.index == bsp.region_index_of(Corner{x, 3, z}) && found.box == bsp.region_at(found.index);
    }
  }
  return is_right;
}

bool has_empty_region(const Bsp& bsp) {
  for (std::uint32_t region = 0; region < bsp.region_count(); ++region) {
    if (volume(bsp.region_at(region)) <= 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("one region is the whole grid") {
  const Bsp bsp = build_bsp(hill(), 1);
  CHECK(bsp.region_count() == 1);
  CHECK(bsp.region_at(0) == core::Region{{}, small_grid});
  CHECK(bsp.owner_of({127, 63, 191}) == nodes::NodeId{0});
}

TEST_CASE("every finest cell has exactly one owner, for any number of regions and either order of axes") {
  for (const CutOrder order : {CutOrder::longer_axis, CutOrder::alternating}) {
    for (const std::uint32_t count : {1U, 2U, 3U, 5U, 7U, 8U, 12U, 16U, 31U, 64U, 100U}) {
      const Bsp bsp = build_bsp(hill(), count, {.order = order});
      CHECK(tiles(bsp));
      CHECK_FALSE(has_empty_region(bsp));
    }
  }
}

TEST_CASE("regions span the grid along the axis that is not cut") {
  const Bsp bsp = build_bsp(hill(), 7);
  for (std::uint32_t region = 0; region < 7; ++region) {
    CHECK(bsp.region_at(region).low[1] == 0);
    CHECK(bsp.region_at(region).high[1] == small_grid[1]);
  }
}

TEST_CASE("equal loads give equal shares, whatever the number of regions") {
  const ColumnLoads even = loads_of([](int, int) { return 1000; });
  for (const std::uint32_t count : {2U, 3U, 5U, 8U, 16U, 24U}) {
    CHECK(dataflow::average_load(loads_of_regions(build_bsp(even, count), even)) > 0.9);
  }
}

TEST_CASE("a hill of load is balanced where regions of equal size are not") {
  const ColumnLoads loads = hill();
  CHECK(dataflow::average_load(loads_of_regions(build_bsp(loads, 16), loads)) > 0.85);
  CHECK(dataflow::average_load(loads_of_regions(dataflow::equal_size_bsp(small_grid, axes_xz, 16), loads)) < 0.3);
}

TEST_CASE("regions of equal size are of equal size") {
  const Bsp bsp = dataflow::equal_size_bsp(small_grid, axes_xz, 16);
  for (std::uint32_t region = 0; region < 16; ++region) {
    CHECK(volume(bsp.region_at(region)) == std::int64_t{128} * 64 * 192 / 16);
  }
}

TEST_CASE("a cut lies on a lattice line unless a column is a hot spot") {
  const ColumnLoads smooth = loads_of([](int i, int) { return 100 + i; }, 32);
  const core::Region low = build_bsp(smooth, 2, {.order = CutOrder::alternating, .hot_spot_share = 0.1}).region_at(0);
  CHECK(low.high[0] % 4 == 0);
  const ColumnLoads spot = loads_of([](int i, int) { return i == 9 ? 1000 : 0; }, 32);
  CHECK(build_bsp(spot, 2, {.order = CutOrder::alternating}).region_at(0).high[0] == 9 * 4 + 2);
}

TEST_CASE("all the load in one finest column still leaves no region empty") {
  const Corner grid{64, 64, 64};
  for (const int corner : {0, 31, 63}) {
    const ColumnLoads spot = loads_of([&](int i, int j) { return i == corner && j == corner ? 1000 : 0; }, 64, grid);
    for (const std::uint32_t count : {2U, 3U, 17U, 64U, 333U, 1024U}) {
      const Bsp bsp = build_bsp(spot, count);
      CHECK(tiles(bsp));
      CHECK_FALSE(has_empty_region(bsp));
    }
  }
}

TEST_CASE("no load at all is shared out like an even one") {
  const ColumnLoads nothing = loads_of([](int, int) { return 0; });
  CHECK_FALSE(has_empty_region(build_bsp(nothing, 64)));
  CHECK(dataflow::average_load(loads_of_regions(build_bsp(nothing, 64), nothing)) == 1.0);
}

TEST_CASE("more regions than finest columns are possible, and some are empty") {
  const Corner tiny{2, 64, 3};
  const ColumnLoads loads = loads_of([](int, int) { return 1; }, 8, tiny);
  const Bsp bsp = build_bsp(loads, 64);
  CHECK(tiles(bsp));
  CHECK(has_empty_region(bsp));
}

TEST_CASE("random loads on random grids are tiled without empty regions") {
  Random random(7);
  for (int trial = 0; trial < 60; ++trial) {
    const Corner grid{static_cast<std::int32_t>(20 + random.below(60)), 4, static_cast<std::int32_t>(20 + random.below(60))};
    const std::uint32_t rarity = 1 + random.below(200);
    const ColumnLoads loads = loads_of([&](int, int) { return random.below(rarity) == 0 ? random.below(1000) : 0; }, 40, grid);
    const Bsp bsp =
        build_bsp(loads, 1 + random.below(64), {.order = trial % 2 == 0 ? CutOrder::longer_axis : CutOrder::alternating});
    CHECK(tiles(bsp));
    CHECK_FALSE(has_empty_region(bsp));
  }
}

TEST_CASE("no region and too many regions are wrong usage") {
  CHECK_THROWS_AS(build_bsp(hill(), 0), core::UsageError);
  CHECK_THROWS_AS(build_bsp(hill(), dataflow::region_count_max + 1), core::UsageError);
}

TEST_CASE("the loads of the regions sum to the load of the columns") {
  const ColumnLoads loads = hill();
  const std::vector<double> parts = loads_of_regions(build_bsp(loads, 13), loads);
  const double whole = std::accumulate(loads.load.begin(), loads.load.end(), 0.0);
  CHECK(std::accumulate(parts.begin(), parts.end(), 0.0) == doctest::Approx(whole).epsilon(1e-9));
}

TEST_CASE("an average load is mean over maximum") {
  CHECK(dataflow::average_load(std::vector<double>{1, 3}) == doctest::Approx(2.0 / 3));
  CHECK(dataflow::average_load(std::vector<double>{5, 5, 5}) == 1.0);
  CHECK(dataflow::average_load({}) == 1.0);
}

TEST_CASE("regions given to other nodes are found at their owners") {
  Bsp bsp = build_bsp(hill(), 4);
  const core::Region second = bsp.region_at(1);
  bsp.assign(std::vector<std::uint32_t>{2, 0, 3, 1});
  CHECK(bsp.region_at(bsp.region_index_of(nodes::NodeId{0})) == second);
  CHECK(bsp.region_index_of(nodes::NodeId{1}) == 3);
  CHECK(bsp.owner_of(second.low) == nodes::NodeId{0});
  CHECK(tiles(bsp));
}

TEST_CASE("regions are given to every node once, or refused") {
  Bsp bsp = build_bsp(hill(), 3);
  CHECK_THROWS_AS(bsp.assign(std::vector<std::uint32_t>{0, 1}), core::InternalError);
  CHECK_THROWS_AS(bsp.assign(std::vector<std::uint32_t>{0, 1, 1}), core::InternalError);
  CHECK_THROWS_AS(bsp.assign(std::vector<std::uint32_t>{0, 1, 3}), core::InternalError);
}

TEST_CASE("units share out the regions that nodes would have without them") {
  for (const std::uint32_t nodes : {1U, 3U, 8U}) {
    for (const std::uint32_t units : {2U, 5U, 16U}) {
      CAPTURE(nodes);
      CAPTURE(units);
      const Bsp bsp = build_bsp(hill(), nodes), cut = dataflow::build_units(hill(), nodes, units);
      CHECK(cut.is_of_units());
      CHECK(cut.node_count() == nodes);
      CHECK(cut.region_count() == nodes * units);
      CHECK(cut.without_units().region_count() == nodes);
      std::vector<std::int64_t> volumes(nodes);
      for (std::uint32_t unit = 0; unit < cut.region_count(); ++unit) {
        CHECK(cut.owner_at(unit) == nodes::NodeId{unit / units});
        volumes[unit / units] += volume(cut.region_at(unit));
      }
      for (std::uint32_t node = 0; node < nodes; ++node) {
        CHECK(cut.without_units().region_at(node) == bsp.region_at(node));
        CHECK(volumes[node] == volume(bsp.region_at(node)));
      }
    }
  }
}

TEST_CASE("units that are given to another node are that one's, and by unit each is a node's of its own") {
  Bsp bsp = dataflow::build_units(hill(), 3, 4);
  const core::Corner cell = bsp.region_at(5).low;
  bsp.give_to(5, nodes::NodeId{2});
  CHECK(bsp.owner_of(cell) == nodes::NodeId{2});
  const Bsp by_unit = bsp.by_unit();
  CHECK(by_unit.node_count() == 12);
  CHECK_FALSE(by_unit.is_of_units());
  for (std::uint32_t unit = 0; unit < 12; ++unit) {
    CHECK(by_unit.region_at(unit) == bsp.region_at(unit));
    CHECK(by_unit.owner_at(unit) == nodes::NodeId{unit});
  }
}

TEST_CASE("by unit those hold nothing whose owner holds nothing") {
  Bsp bsp = dataflow::build_units(hill(), 2, 2);
  for (const std::uint32_t unit : {0U, 2U, 3U}) {
    bsp.mark_empty(unit);
  }
  const Bsp by_unit = bsp.by_unit();
  CHECK_FALSE(by_unit.is_empty(0));
  CHECK_FALSE(by_unit.is_empty(1));
  CHECK(by_unit.is_empty(2));
  CHECK(by_unit.is_empty(3));
}

TEST_CASE("rays walk in the largest leaf of a node's units that cuts end") {
  Bsp bsp = dataflow::build_units(hill(), 2, 4);
  CHECK(bsp.leaf_around(1).count == 4);
  CHECK(bsp.leaf_around(1).box == bsp.without_units().region_at(0));
  bsp.give_to(3, nodes::NodeId{1});
  CHECK(bsp.leaf_around(1).count == 2);
  CHECK(bsp.leaf_around(2).count == 1);
  CHECK(bsp.leaf_around(2).box == bsp.region_at(2));
  CHECK(bsp.leaf_around(3).count == 1);
  bsp.give_to(2, nodes::NodeId{1});
  CHECK(bsp.leaf_around(2).count == 2);
  CHECK_FALSE(bsp.owns(nodes::NodeId{0}, bsp.leaf_around(2)));
}

TEST_CASE("units are as many as may be, or refused with what there may be") {
  CHECK(dataflow::build_units(hill(), 256, 16).region_count() == dataflow::region_count_max);
  CHECK_THROWS_WITH_AS(dataflow::build_units(hill(), 512, 16),
                       "space can be cut into at most 4096 units, not into 16 for each of 512 nodes: ask for fewer of either",
                       core::UsageError);
}

TEST_CASE("the connectivity graph of four quarters is a ring") {
  const Bsp bsp = dataflow::equal_size_bsp({64, 64, 64}, {0, 1}, 4);
  const std::vector<Boundary> expected{{0, 1, 32}, {0, 2, 32}, {1, 3, 32}, {2, 3, 32}};
  CHECK(boundaries_of(bsp, {0, 1}) == expected);
}

TEST_CASE("the connectivity graph has every pair whose rectangles share a length, also where some are empty") {
  for (const std::uint32_t count : {3U, 17U, 64U, 300U, 2000U}) {
    const Bsp bsp = count > 300 ? dataflow::equal_size_bsp({16, 64, 16}, axes_xz, count) : build_bsp(hill(), count);
    std::vector<Boundary> expected;
    for (std::uint32_t a = 0; a < count; ++a) {
      for (std::uint32_t b = a + 1; b < count; ++b) {
        const core::Region low = bsp.region_at(a), high = bsp.region_at(b);
        for (const auto& [along, across] : {std::pair<std::size_t, std::size_t>{0, 2}, {2, 0}}) {
          const bool touch = low.high[across] == high.low[across] || high.high[across] == low.low[across];
          const std::int32_t length = std::min(low.high[along], high.high[along]) - std::max(low.low[along], high.low[along]);
          if (touch && length > 0) {
            expected.push_back({a, b, length});
          }
        }
      }
    }
    CHECK(boundaries_of(bsp, axes_xz) == expected);
  }
}

TEST_CASE("one region has no neighbours") { CHECK(boundaries_of(build_bsp(hill(), 1), axes_xz).empty()); }

}  // namespace dmpc::tests::bsp_test
