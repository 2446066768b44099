// Walks into base meshes of which somebody else does a part, and for which records are lent one by one.
#include "core/trace/below_in_mesh.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "tests/support/base_mesh_scenes.h"
#include "tests/support/scaled.h"

namespace dmpc::tests::below_in_mesh_test {
namespace {

using core::BvhChild;
using core::Hit;
using core::InstanceCursor;

/// The forest, and a record that is lent.
struct ForestRecords {
  core::LocalRecords all;
  std::uint64_t forest_bytes;
  core::Address lent = core::no_address;

  const std::byte* find(core::Address address) {
    return core::byte_offset(address) < forest_bytes || address == lent ? all.find(address) : nullptr;
  }
};

struct Shared {
  core::Operations operations;
  std::uint32_t below = 0, below_in_mesh = 0, lent = 0;
};

class SharedTraversal {
 public:
  explicit SharedTraversal(const core::Database& database)
      : all_(database.bytes()),
        header_(database.header()),
        forest_{all_, database.forest_page_count() * database.page_size()},
        closed_from_((database.forest_page_count() + database.open_page_count()) * database.page_size()) {}

  Hit trace(const core::Ray& ray, Shared& shared) {
    InstanceCursor cursor;
    while (core::trace(ray, cursor, forest_, header_, {}, shared.operations) == core::Traced::absent) {
      forest_.lent = core::no_address;
      if (core::byte_offset(cursor.absent) < closed_from_) {
        CHECK_FALSE(cursor.is_inside);
        forest_.lent = cursor.absent;
        ++shared.lent;
      } else {
        const Hit found = answer(core::below(ray, cursor, {}), cursor, shared);
        core::take_below(found, ray, {}, cursor, shared.operations);
      }
    }
    return cursor.best;
  }

 private:
  Hit answer(const core::Below& below, const InstanceCursor& cursor, Shared& shared) {
    if (cursor.is_inside) {
      ++shared.below_in_mesh;
      return core::trace_below(below, core::reported_instance(cursor), all_, header_, shared.operations);
    }
    ++shared.below;
    return core::trace_below(below, all_, shared.operations);
  }

  core::LocalRecords all_;
  core::DatabaseHeader header_;
  ForestRecords forest_;
  std::uint64_t closed_from_;
};

InstanceCursor cursor_in_mesh(float best_t, std::uint32_t best_id) {
  InstanceCursor cursor;
  cursor.stage = core::Cursor::Stage::child;
  cursor.best = {best_t, best_id, core::Address{7}, 1};
  cursor.next = BvhChild::leaf(core::Address{64});
  cursor.waiting.count = 1;
  cursor.waiting.record[0] = BvhChild::bvh_node(core::Address{500});
  cursor.waiting.t_enter[0] = 4.5F;
  cursor.is_inside = true;
  cursor.next_in_mesh = BvhChild::bvh_node(core::Address{100});
  cursor.waiting_in_mesh.count = 2;
  cursor.waiting_in_mesh.record = {BvhChild::bvh_node(core::Address{300}), BvhChild::bvh_node(core::Address{200})};
  cursor.waiting_in_mesh.t_enter = {6, 3};
  return cursor;
}

}  // namespace

TEST_CASE("a traversal in a mesh goes on with what waits there, while what waits outside waits") {
  core::Operations operations;
  InstanceCursor cursor = cursor_in_mesh(5, 10);
  core::take_below({4, 11, core::Address{9}, 2}, {}, {}, cursor, operations);
  CHECK(cursor.best.primitive == 11);
  CHECK(cursor.is_inside);
  CHECK(cursor.next.address() == core::Address{64});
  CHECK(cursor.next_in_mesh.address() == core::Address{200});
  core::take_below({}, {}, {}, cursor, operations);
  CHECK_FALSE(cursor.next_in_mesh.found());  // the other one lies behind the hit
  CHECK(cursor.waiting.count == 1);
}

TEST_CASE(
    "any hit from below in a mesh ends the traversal of a shadow ray, and what would have been visited outside is counted") {
  core::Operations operations;
  InstanceCursor cursor = cursor_in_mesh(Hit{}.t, core::no_primitive);
  core::take_below({5, 11, core::Address{9}, 2}, {.kind = core::RayKind::shadow}, {}, cursor, operations);
  CHECK_FALSE(cursor.is_inside);
  CHECK_FALSE(cursor.next.found());
  CHECK(operations.skipped.any_hit == 1);
}

TEST_CASE("what is told of a place is what a traversal in its mesh needs, and where its record lies") {
  InstanceCursor cursor = cursor_in_mesh(5, 10);
  cursor.instance.world = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  cursor.instance.first = 77;
  cursor.instance.unit = 0.25F;
  cursor.instance.pad = 1e-6F;
  const core::ReportedInstance place = core::reported_instance(cursor);
  CHECK(place.world == cursor.instance.world);
  CHECK(place.record == core::Address{64});
  CHECK(place.first == 77);
  CHECK(place.unit == 0.25F);
  CHECK(place.pad == 1e-6F);
  CHECK(core::below(core::Ray{}, cursor, {}).child.address() == core::Address{100});
  cursor.is_inside = false;
  CHECK(core::below(core::Ray{}, cursor, {}).child.address() == core::Address{64});
  CHECK_THROWS_AS(std::ignore = core::reported_instance(cursor), core::InternalError);
}

TEST_CASE("rays whose walks in meshes others do meet what they would alone, by the same operations") {
  for (const Arrangement arrangement : {Arrangement::apart, Arrangement::deep_in_each_other, Arrangement::coincident}) {
    for (const std::size_t page_size : {512U, 4096U}) {
      const core::Scene scene = balls_in_places(0.4, arrangement, 31);
      const core::Database database = core::build_database(scene, with_instances(page_size));
      REQUIRE(database.records().instances > 0);
      const int side = scaled_edge(32);
      const core::Camera camera(scene.view, database.header().frame, side, side, 1);
      core::LocalRecords all(database.bytes());
      SharedTraversal walk(database);
      core::Operations alone;
      Shared shared;
      for (std::uint32_t pixel = 0; pixel < static_cast<std::uint32_t>(side * side); ++pixel) {
        core::Ray ray = camera.primary_ray(pixel, 0);
        ray.kind = pixel % 3 == 0 ? core::RayKind::shadow : core::RayKind::primary;
        InstanceCursor one;
        core::trace(ray, one, all, database.header(), {}, alone);
        const Hit found = walk.trace(ray, shared);
        CHECK(found.t == one.best.t);
        CHECK(found.primitive == one.best.primitive);
        CHECK(found.leaf == one.best.leaf);
        CHECK(found.lane == one.best.lane);
      }
      CHECK(shared.below_in_mesh > 0);
      CHECK(shared.lent > 0);
      CHECK(shared.operations.bvh_node_reads == alone.bvh_node_reads);
      CHECK(shared.operations.primitive_tests == alone.primitive_tests);
      CHECK(shared.operations.skipped.any_hit == alone.skipped.any_hit);
    }
  }
}

}  // namespace dmpc::tests::below_in_mesh_test
