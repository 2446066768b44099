// What voxels list, counted on paper.
#include "core/database/grid/voxel_lists.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/record/directory.h"
#include "core/record/records.h"
#include "tests/support/small_scenes.h"

namespace voxel_lists_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

using Voxel = std::array<std::int32_t, 3>;  ///< its place among voxels

Database voxels_of(const Scene& scene, const VoxelRule& rule, std::size_t page_size = 1024) {
  return build_database(scene, {.page_size_bytes = page_size, .structure = Structure::voxels, .voxels = rule});
}

/// Leaves by the voxel that lists them, read back by address.
std::map<Voxel, std::vector<Address>> lists_of(const Database& database) {
  const DatabaseHeader& header = database.header();
  const LocalRecords records(database.bytes());
  std::map<Voxel, std::vector<Address>> lists;
  const auto& size = header.directory_size;
  for (Voxel at{}; at[0] < size[0]; ++at[0]) {
    for (at[1] = 0; at[1] < size[1]; ++at[1]) {
      for (at[2] = 0; at[2] < size[2]; ++at[2]) {
        const std::uint64_t index =
            (std::uint64_t(at[0]) * std::uint64_t(size[1]) + std::uint64_t(at[1])) * std::uint64_t(size[2]) +
            std::uint64_t(at[2]);  // z fastest
        const auto entry = read<DirectoryEntry>(records.find(header.directory) + index * sizeof(DirectoryEntry));
        if (!entry.empty()) {
          for_each_listed(records, header, entry, [&](Address leaf) { lists[at].push_back(leaf); });
        }
      }
    }
  }
  return lists;
}

LeafHeader leaf_at(const Database& database, Address address) {
  return read<LeafHeader>(LocalRecords(database.bytes()).find(address));
}

std::vector<std::uint32_t> ids_in(const Database& database, Address address) {
  const std::byte* const leaf = LocalRecords(database.bytes()).find(address);
  std::vector<std::uint32_t> ids;
  for (std::size_t lane = 0; lane < leaf_at(database, address).count; ++lane) {
    ids.push_back(read<std::uint32_t>(ids_of(leaf_at(database, address), leaf) + lane * sizeof(std::uint32_t)));
  }
  return ids;
}

std::array<std::int32_t, 3> count_of(const Database& database) { return macro_cells(database.header().frame); }

/// So many voxels or a few less, whatever the scene.
VoxelRule about(double voxels, std::size_t objects) { return {.voxels_per_primitive = voxels / static_cast<double>(objects)}; }

/// A ring of `corners` corners across z.
std::vector<Vec3d> ring(int corners) {
  std::vector<Vec3d> places;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    places.push_back({std::cos(angle), std::sin(angle), 0});
  }
  return places;
}

/// Two small balls at the ends of a cube's diagonal, and whatever is between.
Scene between_balls(const std::vector<std::vector<Vec3d>>& polygons) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 0.01);
  builder.sphere({1, 1, 1}, 0.01);
  for (const auto& polygon : polygons) {
    builder.polygon(polygon);
  }
  return scene;
}

std::vector<Vec3d> wall_at(double x) { return {{x, 0.1, 0.1}, {x, 0.9, 0.1}, {x, 0.9, 0.9}, {x, 0.1, 0.9}}; }

std::vector<Vec3d> small_triangle(double x, double y, double z) {
  return {{x, y, z}, {x + 0.01, y, z}, {x, y + 0.01, z + 0.005}};
}

}  // namespace

TEST_CASE("one polygon and one voxel make one reference, to a leaf of all its triangles") {
  Scene scene;
  SceneBuilder(scene).polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}});
  const Database database = voxels_of(scene, {.voxels_per_primitive = 1});
  CHECK(count_of(database) == Voxel{1, 1, 1});
  const auto lists = lists_of(database);
  REQUIRE(lists.size() == 1);
  REQUIRE(lists.at({0, 0, 0}).size() == 1);
  CHECK(ids_in(database, lists.at({0, 0, 0}).front()) == std::vector<std::uint32_t>{0, 1});
  CHECK(database.records().voxel_references == 1);
  CHECK(database.records().leaves[0] == 1);
  CHECK(database.records().bvh_nodes == 0);
  CHECK(database.references() == 2);
}

TEST_CASE("a flat scene has one layer of voxels, and a polygon across all of them is in every list") {
  Scene scene;
  SceneBuilder(scene).polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Database database = voxels_of(scene, {.voxels_per_primitive = 16});
  CHECK(count_of(database) == Voxel{4, 4, 1});
  const auto lists = lists_of(database);
  CHECK(lists.size() == 16);
  CHECK(database.records().voxel_references == 16);
  std::set<Address> leaves;
  for (const auto& [voxel, list] : lists) {
    leaves.insert(list.begin(), list.end());
  }
  CHECK(leaves.size() == 1);
}

TEST_CASE("a polygon on the plane between two layers of voxels is listed on both sides, and nowhere else") {
  const GridFrame frame = voxels_of(between_balls({wall_at(0.5)}), about(64, 3)).header().frame;
  REQUIRE(macro_cells(frame) == Voxel{4, 4, 4});
  const double plane = frame.origin.x + plane_at(frame, 0, 2 * finest_per_macro) / frame.scale;
  const Database database = voxels_of(between_balls({wall_at(plane)}), about(64, 3));
  REQUIRE(database.header().frame.finest_cell == frame.finest_cell);
  std::map<std::int32_t, int> listed_by_layer;
  for (const auto& [voxel, list] : lists_of(database)) {
    for (const Address leaf : list) {
      listed_by_layer[voxel[0]] += leaf_at(database, leaf).kind == PrimitiveKind::triangle ? 1 : 0;
    }
  }
  CHECK(listed_by_layer[0] == 0);
  CHECK(listed_by_layer[1] == 16);
  CHECK(listed_by_layer[2] == 16);
  CHECK(listed_by_layer[3] == 0);
}

TEST_CASE("a leaning triangle is listed where it goes, and by the article's rule wherever its box does") {
  const Scene scene = between_balls({{{0.05, 0.05, 0.4}, {0.95, 0.95, 0.4}, {0.95, 0.9, 0.4}}});
  VoxelRule rule = about(64, 3);
  const auto count = [&] {
    std::uint64_t listed = 0;
    const Database database = voxels_of(scene, rule);
    REQUIRE(count_of(database) == Voxel{4, 4, 4});
    for (const auto& [voxel, list] : lists_of(database)) {
      for (const Address leaf : list) {
        listed += leaf_at(database, leaf).kind == PrimitiveKind::triangle ? 1 : 0;
      }
    }
    return listed;
  };
  const std::uint64_t touched = count();
  CHECK(touched >= 4);
  CHECK(touched <= 10);
  rule.lists_boxes = true;
  CHECK(count() == 16);  // the layer
}

TEST_CASE("primitives that lie in one voxel are listed there alone, each once") {
  std::vector<std::vector<Vec3d>> polygons;
  for (int i = 0; i < 30; ++i) {
    polygons.push_back(small_triangle(0.45 + 0.003 * i, 0.5, 0.5));
  }
  const Database database = voxels_of(between_balls(polygons), about(27, 32));
  CHECK(count_of(database) == Voxel{3, 3, 3});
  const auto lists = lists_of(database);
  REQUIRE(lists.contains({1, 1, 1}));
  CHECK(lists.at({1, 1, 1}).size() == 30);
  CHECK(database.records().voxel_references == 32);
  CHECK(lists.size() == 3);
}

TEST_CASE("spheres and cones have a record each, and a polygon has one for each 8 of its triangles") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  builder.cone({3, 0, 0}, 1, {3, 0, 2}, 0.5);
  builder.cone({3, 3, 0}, 1, {3, 3, 2}, 1);
  builder.polygon(ring(12));  // 10 triangles
  builder.polygon({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}});
  const Database database = voxels_of(scene, {.voxels_per_primitive = 0.1});
  CHECK(database.records().leaves == std::array<std::uint64_t, 3>{3, 1, 2});
  std::multiset<std::size_t> triangles;
  const auto lists = lists_of(database);
  for (const Address leaf : lists.at({0, 0, 0})) {
    const LeafHeader header = leaf_at(database, leaf);
    if (header.kind == PrimitiveKind::triangle) {
      triangles.insert(header.count);
    } else {
      CHECK(header.count == 1);
    }
  }
  CHECK(triangles == std::multiset<std::size_t>{1, 2, 8});
}

TEST_CASE("a list longer than a page is whole, and every primitive has its place") {
  std::vector<std::vector<Vec3d>> polygons;
  for (int i = 0; i < 300; ++i) {
    polygons.push_back(small_triangle(0.4 + 0.0005 * i, 0.5, 0.5));
  }
  const Database database = voxels_of(between_balls(polygons), about(1, 302), 512);
  const auto lists = lists_of(database);
  CHECK(lists.at({0, 0, 0}).size() == 302);
  const auto places = database.find_places();
  for (std::uint32_t id = 0; id < database.header().primitive_count; ++id) {
    const auto ids = ids_in(database, places[id].leaf);
    REQUIRE(places[id].lane < ids.size());
    CHECK(ids[places[id].lane] == id);
  }
}

TEST_CASE("empty voxels know how far the next list is, but not by the article's rule") {
  VoxelRule rule = about(1000, 2);
  const auto radii = [&] {
    const Database database = voxels_of(between_balls({}), rule);
    REQUIRE(count_of(database) == Voxel{10, 10, 10});
    const auto entry = [&](std::int32_t x) {
      const std::uint64_t index = directory_index(database.header(), {x * finest_per_macro, 0, 0});
      const LocalRecords records(database.bytes());
      return read<DirectoryEntry>(records.find(directory_address(database.header(), index)) + directory_offset(index));
    };
    CHECK(!entry(0).empty());
    return std::array{entry(1).radius(), entry(4).radius(), entry(9).radius()};
  };
  CHECK(radii() == std::array{1, 4, 9});
  rule.measures_empty_space = false;
  CHECK(radii() == std::array{1, 1, 1});
}

TEST_CASE("the article's rule makes 14 voxels a polygon, 64 times 64 times 64 at most, and 129 bytes a polygon") {
  const Database rings = voxels_of(built_in("tetra-4"), article_voxels);
  const std::size_t polygons = built_in("tetra-4").objects.size();
  REQUIRE(polygons == 256);
  const auto count = count_of(rings);
  const double voxels = double(count[0]) * count[1] * count[2];
  CHECK(voxels <= 14.0 * 256);
  CHECK(voxels >= 0.9 * 14 * 256);
  const double bytes = 4 * voxels + 4 * double(rings.records().voxel_references) + 129.0 * double(polygons);
  CHECK(double(rings.page_count()) * 1024 >= bytes);
  CHECK(double(rings.page_count()) * 1024 <= bytes + 2048);  // materials, lights, what the last page leaves
  CHECK(count_of(voxels_of(built_in("tetra-8"), article_voxels)) == Voxel{64, 64, 64});
}

TEST_CASE("the normals of a smooth polygon are within its bytes") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 64; ++i) {
    const double x = i % 8, y = i / 8;
    builder.patch({{x, y, 0}, {x + 1, y, 0}, {x, y + 1, 0}}, {{0, 0, 1}, {0, 0.1, 1}, {0.1, 0, 1}});
  }
  VoxelRule rule{.voxels_max = 1};
  const std::size_t needed = voxels_of(scene, rule, 512).page_count();
  CHECK(needed * 512 < 64 * 129);
  rule.record_bytes = 129;
  CHECK(voxels_of(scene, rule, 512).page_count() * 512 <= 64 * 129 + 1024);
  CHECK(voxels_of(scene, rule, 512).page_count() * 512 >= 64 * 129);
}

TEST_CASE("lists or voxels that no memory has room for are refused with the figure") {
  VoxelRule rule = about(64, 3);
  rule.references_max = 12;
  CHECK_THROWS_WITH_AS(voxels_of(between_balls({wall_at(0.5)}), rule),
                       doctest::Contains("the lists of 4x4x4 voxels would name more than 12 primitives"), CapacityError);
}

TEST_CASE("a scene without anything has one empty voxel") {
  const Database database = voxels_of(Scene{}, usual_voxels);
  CHECK(count_of(database) == Voxel{1, 1, 1});
  CHECK(lists_of(database).empty());
  CHECK(database.header().has_voxels());
}

TEST_CASE("voxels keep the primitives and local zero of the grid, to the last bit") {
  for (const char* name : {"gears-1", "balls-2", "shells-2"}) {
    CAPTURE(name);
    const Database grid = build_database(built_in(name), {}), voxels = voxels_of(built_in(name), usual_voxels);
    REQUIRE(grid.primitives().size() == voxels.primitives().size());
    for (std::size_t id = 0; id < grid.primitives().size(); ++id) {
      CHECK(grid.primitives()[id].value == voxels.primitives()[id].value);
    }
    CHECK(grid.header().frame.origin == voxels.header().frame.origin);
    CHECK(grid.header().frame.low == voxels.header().frame.low);
  }
}

}  // namespace voxel_lists_test
