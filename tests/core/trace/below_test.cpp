// Walks of which somebody else does a part: what is merged, and that nothing differs.
#include "core/trace/below.h"

#include <doctest/doctest.h>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "tests/support/small_scenes.h"

namespace below_test {

namespace {

using namespace dmpc;
using core::BvhChild;
using core::Hit;

/// The forest alone, or all.
struct ForestRecords {
  core::LocalRecords all;
  std::uint64_t forest_bytes;

  const std::byte* find(core::Address address) { return core::byte_offset(address) < forest_bytes ? all.find(address) : nullptr; }
};

core::Cursor waiting_cursor(float best_t, std::uint32_t best_id) {
  core::Cursor cursor;
  cursor.stage = core::Cursor::Stage::child;
  cursor.best = {best_t, best_id, core::Address{7}, 1};
  cursor.next = BvhChild::bvh_node(core::Address{100});
  cursor.waiting.count = 2;
  cursor.waiting.record = {BvhChild::bvh_node(core::Address{300}), BvhChild::bvh_node(core::Address{200})};
  cursor.waiting.t_enter = {6, 3};
  return cursor;
}

}  // namespace

TEST_CASE("a hit from below takes the place of a farther one, or of one as far with a higher id") {
  core::Operations operations;
  for (const Hit& known : {Hit{}, Hit{5, 10, core::Address{7}, 1}, Hit{4, 12, core::Address{7}, 1}}) {
    core::Cursor cursor = waiting_cursor(known.t, known.primitive);
    core::take_below({4, 11, core::Address{9}, 2}, {}, {}, cursor, operations);
    CHECK(cursor.best.primitive == 11);
    CHECK(cursor.best.leaf == core::Address{9});
    CHECK(cursor.best.lane == 2);
    CHECK(cursor.next.address() == core::Address{200});
  }
}

TEST_CASE("a hit from below that is not nearer is a broken promise") {
  core::Operations operations;
  for (const Hit& known : {Hit{3, 10, core::Address{7}, 1}, Hit{4, 10, core::Address{7}, 1}}) {
    core::Cursor cursor = waiting_cursor(known.t, known.primitive);
    CHECK_THROWS_AS(core::take_below({4, 11, core::Address{9}, 2}, {}, {}, cursor, operations), core::InternalError);
  }
}

TEST_CASE("nothing below leaves the hit and goes on with the next child, and behind a hit there is none") {
  core::Operations operations;
  core::Cursor cursor = waiting_cursor(5, 10);
  core::take_below({}, {}, {}, cursor, operations);
  CHECK(cursor.best.primitive == 10);
  CHECK(cursor.next.address() == core::Address{200});
  core::take_below({2, 11, core::Address{9}, 2}, {}, {}, cursor, operations);
  CHECK_FALSE(cursor.next.found());
}

TEST_CASE("any hit from below ends the traversal of a shadow ray, and what it would have visited is counted") {
  core::Operations operations;
  core::Cursor cursor = waiting_cursor(Hit{}.t, core::no_primitive);
  core::take_below({4, 11, core::Address{9}, 2}, {.kind = core::RayKind::shadow}, {}, cursor, operations);
  CHECK_FALSE(cursor.next.found());
  CHECK(operations.skipped.any_hit == 1);
}

TEST_CASE("rays whose walks below the forest others do meet what they would alone, by the same operations") {
  for (const char* name : {"gears-1", "teapot-4", "balls-3"}) {
    const core::Scene scene = tests::built_in(name);
    const core::Database database = core::build_database(scene, {.page_size_bytes = 512, .structure = core::Structure::extents});
    core::LocalRecords all(database.bytes());
    ForestRecords forest{all, database.forest_page_count() * database.page_size()};
    const core::Camera camera(scene.view, database.header().frame, 24, 24, 1);
    core::Operations alone, shared;
    std::uint32_t questions = 0;
    for (std::uint32_t pixel = 0; pixel < 24 * 24; ++pixel) {
      core::Ray ray = camera.primary_ray(pixel, 0);
      ray.kind = pixel % 3 == 0 ? core::RayKind::shadow : core::RayKind::primary;
      core::Cursor one, other;
      const core::Traced expected = core::trace(ray, one, all, database.header(), {}, alone);
      core::Traced traced = core::trace(ray, other, forest, database.header(), {}, shared);
      for (; traced == core::Traced::absent; traced = core::trace(ray, other, forest, database.header(), {}, shared)) {
        ++questions;
        core::take_below(core::trace_below(core::below(ray, other, {}), all, shared), ray, {}, other, shared);
      }
      CHECK(traced == expected);
      CHECK(other.best.t == one.best.t);
      CHECK(other.best.primitive == one.best.primitive);
      CHECK(other.best.leaf == one.best.leaf);
      CHECK(other.best.lane == one.best.lane);
    }
    CHECK(questions > 100);
    CHECK(shared.bvh_node_reads == alone.bvh_node_reads);
    CHECK(shared.primitive_tests == alone.primitive_tests);
    CHECK(shared.cell_steps == alone.cell_steps);
    CHECK(shared.skipped.any_hit == alone.skipped.any_hit);
  }
}

}  // namespace below_test
