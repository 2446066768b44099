#include "core/database/grid/empty_space.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/record/directory.h"

namespace empty_space_test {

using namespace dmpc::core;

namespace {

/// A row of macro cells, those at `occupied` with a BVH node.
std::vector<int> radii_of_row(std::int32_t count, const std::vector<std::int32_t>& occupied) {
  const std::array<std::int32_t, 3> size{count, 1, 1};
  std::vector<DirectoryEntry> directory(directory_entry_count(size));
  const auto entry = [&](std::int32_t x) -> DirectoryEntry& {
    return directory[directory_index(size, {x * finest_per_macro, 0, 0})];
  };
  for (const std::int32_t x : occupied) {
    entry(x).bits = 5;
  }
  measure_empty_space(size, directory);
  std::vector<int> radii;
  for (std::int32_t x = 0; x < count; ++x) {
    radii.push_back(entry(x).empty() ? entry(x).radius() : 0);
  }
  return radii;
}

}  // namespace

TEST_CASE("an empty cell knows how far the nearest BVH node is") {
  CHECK(radii_of_row(8, {1, 6}) == std::vector<int>{1, 0, 1, 2, 2, 1, 0, 1});
  CHECK(radii_of_row(1, {0}) == std::vector<int>{0});
}

TEST_CASE("radii end at the greatest, and are that where nothing is") {
  CHECK(radii_of_row(3, {}) == std::vector<int>{radius_max, radius_max, radius_max});
  const std::vector<int> radii = radii_of_row(100, {0});
  CHECK(radii[radius_max - 1] == radius_max - 1);
  CHECK(radii[radius_max] == radius_max);
  CHECK(radii[99] == radius_max);
}

TEST_CASE("diagonal neighbours are as near as any") {
  const std::array<std::int32_t, 3> size{3, 3, 3};
  std::vector<DirectoryEntry> directory(directory_entry_count(size));
  directory[0].bits = 5;
  measure_empty_space(size, directory);
  const auto radius = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return directory[directory_index(size, {x * finest_per_macro, y * finest_per_macro, z * finest_per_macro})].radius();
  };
  CHECK(radius(1, 1, 1) == 1);
  CHECK(radius(2, 1, 0) == 2);
  CHECK(radius(2, 2, 2) == 2);
}

}  // namespace empty_space_test
