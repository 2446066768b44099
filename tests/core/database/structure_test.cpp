// How records lie: one tree of extents, of which nothing but boxes differs from the grid, and pages without any order.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/database/record_writer.h"
#include "core/database/structure.h"
#include "core/families/scenes.h"
#include "core/picture/camera/camera.h"
#include "core/record/records.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace structure_test {

namespace {

using namespace dmpc;
using core::Address;
using core::Structure;

core::BuildOptions options_of(const core::Scene& scene, Structure structure, std::size_t page_size) {
  core::BuildOptions options = apps::several_macro_cells(scene);
  options.structure = structure;
  options.page_size_bytes = page_size;
  return options;
}

/// What is found below a BVH node.
struct Found {
  std::uint32_t forest_bvh_nodes = 0, subtrees = 0;
  std::vector<std::uint32_t> primitives;  ///< how often each
};

class Walker {
 public:
  explicit Walker(const core::Database& database)
      : database_(database), records_(database.bytes()), found_{.primitives = std::vector<std::uint32_t>(count(database))} {}

  Found all() {
    const auto entry = core::read<core::DirectoryEntry>(records_.find(database_.header().directory));
    REQUIRE(!entry.empty());
    visit(core::BvhChild::bvh_node(entry.bvh_node()), 0);
    return found_;
  }

 private:
  static std::uint32_t count(const core::Database& database) { return database.header().primitive_count; }
  std::size_t page_of(Address address) const { return core::byte_offset(address) / database_.page_size(); }

  /// `page`: of the subtree, 0 in the forest.
  void visit(core::BvhChild child, std::size_t page) {
    const std::size_t own = page_of(child.address());
    const bool is_in_forest = own < database_.forest_page_count();
    if (page == 0 && !is_in_forest) {
      ++found_.subtrees;
    } else if (page != 0) {
      CHECK(own == page);
    }
    if (child.is_leaf()) {
      visit_leaf(child.address());
      return;
    }
    found_.forest_bvh_nodes += is_in_forest ? 1 : 0;
    const auto bvh_node = core::read<core::BvhNode>(records_.find(child.address()));
    const auto is_leaf = [&](std::size_t i) { return bvh_node.child[i].is_leaf(); };
    bool has_bvh_nodes = false;
    for (std::size_t i = 0; i < bvh_node.child_count; ++i) {
      has_bvh_nodes = has_bvh_nodes || !is_leaf(i);
    }
    for (std::size_t i = 0; is_in_forest && has_bvh_nodes && i < bvh_node.child_count; ++i) {
      CHECK((!is_leaf(i) || page_of(bvh_node.child[i].address()) < database_.forest_page_count()));
    }
    for (std::size_t i = 0; i < bvh_node.child_count; ++i) {
      visit(bvh_node.child[i], is_in_forest ? 0 : own);
    }
  }

  void visit_leaf(Address address) {
    const std::byte* const leaf = records_.find(address);
    const auto header = core::read<core::LeafHeader>(leaf);
    for (std::uint32_t lane = 0; lane < header.count; ++lane) {
      ++found_.primitives[core::read<std::uint32_t>(core::ids_of(header, leaf) + lane * sizeof(std::uint32_t))];
    }
  }

  const core::Database& database_;
  core::LocalRecords records_;
  Found found_;
};

std::vector<std::uint16_t> random_sizes(std::size_t count) {
  apps::Random random(count);
  std::vector<std::uint16_t> sizes(count);
  for (std::uint16_t& size : sizes) {
    size = static_cast<std::uint16_t>(1 + random.below(core::record_bytes_max));
  }
  return sizes;
}

core::BuildOptions scattered() {
  core::BuildOptions options;
  options.record_order = core::RecordOrder::scattered;
  return options;
}

}  // namespace

TEST_CASE("behind the forest a page has all that is below what it has, and leaves beside BVH nodes are in the forest") {
  for (const char* name : {"gears-1", "teapot-4", "balls-3"}) {
    const core::Scene scene = tests::built_in(name);
    for (const std::size_t page_size : {512U, 1024U, 4096U, 65536U}) {
      CAPTURE(name);
      CAPTURE(page_size);
      const core::Database database = core::build_database(scene, options_of(scene, Structure::extents, page_size));
      const Found found = Walker(database).all();
      for (const std::uint32_t times : found.primitives) {
        CHECK(times == 1);
      }
      CHECK(database.references() == database.header().primitive_count);
      CHECK(found.subtrees >= 1);
      CHECK(database.forest_page_count() >= 1);
      CHECK(database.forest_page_count() < database.page_count());
      CHECK((found.forest_bvh_nodes > 0 || page_size == 65536));
    }
  }
}

TEST_CASE("one tree has one macro cell, and the very primitives of the grid") {
  const core::Scene scene = tests::built_in("gears-1");
  const core::Database grid = core::build_database(scene, options_of(scene, Structure::grid, 1024)),
                       tree = core::build_database(scene, options_of(scene, Structure::extents, 1024));
  CHECK(core::macro_cells(grid.header().frame) != std::array<std::int32_t, 3>{1, 1, 1});
  CHECK(core::macro_cells(tree.header().frame) == std::array<std::int32_t, 3>{1, 1, 1});
  CHECK(tree.header().frame.origin == grid.header().frame.origin);
  CHECK(tree.header().frame.scale == grid.header().frame.scale);
  REQUIRE(tree.primitives().size() == grid.primitives().size());
  for (std::size_t id = 0; id < tree.primitives().size(); ++id) {
    CHECK(tree.primitives()[id].value == grid.primitives()[id].value);
  }
  CHECK(grid.forest_page_count() == 0);
}

TEST_CASE("rays of eyes far away start at the same floats in one tree as in the grid") {
  for (const char* name : {"gears-1", "shells-2", "mount-5"}) {
    core::Scene scene = tests::built_in(name);
    scene.view.from = scene.view.at + (scene.view.from - scene.view.at) * 20.0;
    const core::Database grid = core::build_database(scene, options_of(scene, Structure::grid, 1024)),
                         tree = core::build_database(scene, options_of(scene, Structure::extents, 1024));
    const core::Camera one(scene.view, grid.header().frame, 8, 8, 1), other(scene.view, tree.header().frame, 8, 8, 1);
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
      CHECK(one.primary_ray(pixel, 0).origin == other.primary_ray(pixel, 0).origin);
    }
  }
}

TEST_CASE("a scene without objects, and one tree whose records are scattered, have no subtrees to ask about") {
  core::Scene empty = tests::built_in("tetra-3");
  empty.objects.clear();
  CHECK(core::build_database(empty, {.structure = Structure::extents}).forest_page_count() == 1);
  const core::Scene scene = tests::built_in("tetra-3");
  const core::Database scattered =
      core::build_database(scene, {.record_order = core::RecordOrder::scattered, .structure = Structure::extents});
  CHECK(scattered.forest_page_count() == 0);
}

TEST_CASE("no records have no places, and a single one has the first") {
  CHECK(core::scattered_places({}, 1000, 1024).empty());
  CHECK(core::scattered_places(std::vector<std::uint16_t>{40}, 100, 1024) == std::vector{core::Address{13}});
  CHECK(core::scattered_places(std::vector<std::uint16_t>{40}, 1000, 1024) == std::vector{core::Address{128}});
}

TEST_CASE("scattered records lie apart, none across a page's border, behind the front") {
  constexpr std::size_t front_bytes = 3000, page_size = 1024;
  const std::vector<std::uint16_t> sizes = random_sizes(5000);
  const std::vector<core::Address> places = core::scattered_places(sizes, front_bytes, page_size);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> extents;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::uint64_t first = core::byte_offset(places[i]), last = first + sizes[i] - 1;
    CHECK(first / page_size == last / page_size);
    extents.emplace_back(first, last);
  }
  std::sort(extents.begin(), extents.end());
  CHECK(extents.front().first >= front_bytes);
  for (std::size_t i = 1; i < extents.size(); ++i) {
    CHECK(extents[i - 1].second < extents[i].first);
  }
}

TEST_CASE("scattered records that were neighbours share a page no more often than by chance") {
  const std::vector<std::uint16_t> sizes(10000, 256);
  const std::vector<core::Address> places = core::scattered_places(sizes, 0, 1024);
  int together = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    together += core::byte_offset(places[i - 1]) / 1024 == core::byte_offset(places[i]) / 1024 ? 1 : 0;
  }
  CHECK(together <= 20);  // 12 are expected: 3 of 10,000 places beside each
}

TEST_CASE("a database of scattered records gives the same picture by the same operations") {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("rings-2-t1"));
  const tests::Subject spatial(scene, {48, 48, 1}), other(scene, {48, 48, 1}, scattered());
  CHECK(other.outcome() == spatial.outcome());
  CHECK_FALSE(std::ranges::equal(spatial.database().bytes(), other.database().bytes()));
  CHECK(static_cast<double>(other.database().page_count()) ==
        doctest::Approx(static_cast<double>(spatial.database().page_count())).epsilon(0.1));
}

TEST_CASE("scattered records are the same bytes whenever they are built") {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("tetra-4"));
  CHECK(std::ranges::equal(core::build_database(scene, scattered()).bytes(), core::build_database(scene, scattered()).bytes()));
}

}  // namespace structure_test
