// One tree of extents: where its records lie, and that nothing but boxes differs from the grid.
#include "core/database/structure.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "apps/lab/bench/stability/cells.h"
#include "core/database/database.h"
#include "core/picture/camera.h"
#include "core/record/records.h"
#include "tests/support/small_scenes.h"

namespace structure_test {

namespace {

using namespace dmpc;
using core::Address;
using core::Structure;

core::BuildOptions options_of(const core::Scene& scene, Structure structure, std::size_t page_size) {
  core::BuildOptions options = apps::several_top_cells(scene);
  options.structure = structure;
  options.page_size_bytes = page_size;
  return options;
}

/// What is found below a brick.
struct Found {
  std::uint32_t forest_bricks = 0, subtrees = 0;
  std::vector<std::uint32_t> primitives;  ///< how often each
};

class Walker {
 public:
  explicit Walker(const core::Database& database)
      : database_(database), records_(database.bytes()), found_{.primitives = std::vector<std::uint32_t>(count(database))} {}

  Found all() {
    const auto entry = core::read<core::DirectoryEntry>(records_.find(database_.header().directory));
    REQUIRE(!entry.empty());
    visit(core::BrickChild::brick(entry.brick()), 0);
    return found_;
  }

 private:
  static std::uint32_t count(const core::Database& database) { return database.header().primitive_count; }
  std::size_t page_of(Address address) const { return core::byte_offset(address) / database_.page_size(); }

  /// `page`: of the subtree, 0 in the forest.
  void visit(core::BrickChild child, std::size_t page) {
    const std::size_t own = page_of(child.address());
    const bool is_in_forest = own < database_.forest_page_count();
    if (page == 0 && !is_in_forest) {
      ++found_.subtrees;
    } else if (page != 0) {
      CHECK(own == page);
    }
    if (child.is_block()) {
      visit_block(child.address());
      return;
    }
    found_.forest_bricks += is_in_forest ? 1 : 0;
    const auto brick = core::read<core::Brick>(records_.find(child.address()));
    const auto is_block = [&](std::size_t i) { return brick.child[i].is_block(); };
    bool has_bricks = false;
    for (std::size_t i = 0; i < brick.child_count; ++i) {
      has_bricks = has_bricks || !is_block(i);
    }
    for (std::size_t i = 0; is_in_forest && has_bricks && i < brick.child_count; ++i) {
      CHECK((!is_block(i) || page_of(brick.child[i].address()) < database_.forest_page_count()));
    }
    for (std::size_t i = 0; i < brick.child_count; ++i) {
      visit(brick.child[i], is_in_forest ? 0 : own);
    }
  }

  void visit_block(Address address) {
    const std::byte* const block = records_.find(address);
    const auto header = core::read<core::BlockHeader>(block);
    for (std::uint32_t lane = 0; lane < header.count; ++lane) {
      ++found_.primitives[core::read<std::uint32_t>(core::ids_of(header, block) + lane * sizeof(std::uint32_t))];
    }
  }

  const core::Database& database_;
  core::LocalRecords records_;
  Found found_;
};

}  // namespace

TEST_CASE("behind the forest a page has all that is below what it has, and blocks beside bricks are in the forest") {
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
      CHECK((found.forest_bricks > 0 || page_size == 65536));
    }
  }
}

TEST_CASE("one tree has one top cell, and the very primitives of the grid") {
  const core::Scene scene = tests::built_in("gears-1");
  const core::Database grid = core::build_database(scene, options_of(scene, Structure::grid, 1024)),
                       tree = core::build_database(scene, options_of(scene, Structure::extents, 1024));
  CHECK(core::top_cells(grid.header().frame) != std::array<std::int32_t, 3>{1, 1, 1});
  CHECK(core::top_cells(tree.header().frame) == std::array<std::int32_t, 3>{1, 1, 1});
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

}  // namespace structure_test
