#include "core/database/grid/macro_cells.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/base/morton.h"

namespace macro_cells_test {

using namespace dmpc::core;

namespace {

/// 4 by 2 by 2 macro cells of edge 1.
GridFrame frame() {
  GridFrame frame;
  frame.resolution = {4 * cells_per_macro, 2 * cells_per_macro, 2 * cells_per_macro};
  frame.finest_cell = 1.0F / finest_per_macro;
  return frame;
}

PrimitiveValues sphere(float x, float y, float z, float radius) {
  return {.kind = PrimitiveKind::sphere, .value = {x, y, z, radius}};
}

MacroCells cells_of(const std::vector<PrimitiveValues>& primitives, std::uint32_t threads = 1) {
  return MacroCells::list(primitives, frame(), 0.01, Parallel(threads)).value();
}

}  // namespace

TEST_CASE("nothing touches no cell") { CHECK(cells_of({}).size() == 0); }

TEST_CASE("a primitive within a cell is listed there alone") {
  const MacroCells cells = cells_of({sphere(2.5, 1.5, 0.5, 0.25)});
  REQUIRE(cells.size() == 1);
  CHECK(cells.corner(0) == Corner{2 * finest_per_macro, finest_per_macro, 0});
  CHECK(cells.ids(0).size() == 1);
  CHECK(cells.references() == 1);
}

TEST_CASE("one that comes within the pad of a cell is listed there, one farther off is not") {
  CHECK(cells_of({sphere(0.5F, 0.5F, 0.5F, 0.495F)}).size() == 4);
  CHECK(cells_of({sphere(0.5F, 0.5F, 0.5F, 0.48F)}).size() == 1);
}

TEST_CASE("cells come in Morton order with ascending primitives, whatever the number of threads") {
  std::vector<PrimitiveValues> primitives;
  for (int i = 0; i < 20'000; ++i) {
    const auto at = [&](int step, float edge) { return edge * static_cast<float>((i * step) % 1009) / 1009.0F; };
    primitives.push_back(sphere(at(17, 4), at(29, 2), at(43, 2), 0.01F));
  }
  const MacroCells one = cells_of(primitives), many = cells_of(primitives, 4);
  REQUIRE(one.size() == 16);
  REQUIRE(many.size() == 16);
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const auto at = [&](std::size_t axis) { return static_cast<std::uint64_t>(one.corner(i)[axis] / finest_per_macro); };
    const std::uint64_t code = morton_code(at(0), at(1), at(2));
    CHECK((i == 0 || code > last));
    last = code;
    CHECK(std::is_sorted(one.ids(i).begin(), one.ids(i).end()));
    CHECK(std::equal(one.ids(i).begin(), one.ids(i).end(), many.ids(i).begin(), many.ids(i).end()));
  }
}

TEST_CASE("a primitive is listed in the cells that it is listed in alone, whatever stands beside it") {
  std::vector<PrimitiveValues> primitives;
  for (int i = 0; i < 100; ++i) {
    const auto at = [&](int step, float edge) { return edge * static_cast<float>((i * step) % 101) / 101.0F; };
    const float x = at(17, 4), y = at(29, 2), z = at(43, 2), size = at(57, 0.7F);
    if (i % 3 == 0) {
      primitives.push_back(sphere(x, y, z, size));
    } else {
      primitives.push_back({.kind = PrimitiveKind::triangle, .value = {x, y, z, x - size, y, z + size, x, y - size, z}});
    }
  }
  const MacroCells all = cells_of(primitives);
  std::size_t listed = 0;
  for (std::uint32_t id = 0; id < primitives.size(); ++id) {
    const MacroCells alone = cells_of({primitives[id]});
    listed += alone.size();
    for (std::size_t i = 0; i < alone.size(); ++i) {
      std::size_t same = 0;
      while (same < all.size() && all.corner(same) != alone.corner(i)) {
        ++same;
      }
      REQUIRE(same < all.size());
      CHECK(std::binary_search(all.ids(same).begin(), all.ids(same).end(), id));
    }
  }
  CHECK(all.references() == listed);
}

TEST_CASE("lists that would be long are not made") {
  const std::vector<PrimitiveValues> everywhere(100, sphere(2, 1, 1, 1));
  CHECK_FALSE(MacroCells::list(everywhere, frame(), 0.01, Parallel(1)).has_value());
  GridFrame single = frame();
  single.resolution = {1, 1, 1};
  CHECK(MacroCells::list(everywhere, single, 0.01, Parallel(1)).has_value());
}

}  // namespace macro_cells_test
