// A ray's way through voxels and their lists, counted on paper, and interrupted at every record.
#include <doctest/doctest.h>

#include <cstdint>

#include "core/database/database.h"
#include "core/scene/frame.h"
#include "core/trace/traversal.h"
#include "tests/support/small_scenes.h"

namespace voxel_traversal_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Counts look-ups; a forgetful one has a record only when it is asked for it the second time in a row.
class Watched {
 public:
  explicit Watched(const Database& database, bool is_forgetful = false)
      : records_(database.bytes()), is_forgetful_(is_forgetful) {}

  const std::byte* find(Address address) {
    if (is_forgetful_ && (!has_missed_ || missed_ != address)) {
      missed_ = address;
      has_missed_ = true;
      return nullptr;
    }
    has_missed_ = false;
    ++look_ups;
    return records_.find(address);
  }

  std::uint64_t look_ups = 0;

 private:
  LocalRecords records_;
  bool is_forgetful_, has_missed_ = false;
  Address missed_ = no_address;
};

struct Walked {
  Traced traced{};
  Hit best;
  Operations operations;
  std::uint64_t look_ups = 0, interruptions = 0;
};

Ray ray_of(const Database& database, const Vec3d& from, const Vec3d& towards, RayKind kind = RayKind::primary) {
  Ray ray;
  ray.kind = kind;
  ray.start_at(to_local(database.header().frame, from));
  ray.go_along(normalize(towards));
  return ray;
}

Walked walk(const Database& database, const Ray& ray, bool is_forgetful = false, const Skips& skips = {}) {
  Walked walked;
  Watched records(database, is_forgetful);
  Cursor cursor;
  while ((walked.traced = trace(ray, cursor, records, database.header(), skips, walked.operations)) == Traced::absent) {
    ++walked.interruptions;
  }
  walked.best = cursor.best;
  walked.look_ups = records.look_ups;
  return walked;
}

Database voxels_of(const Scene& scene, const VoxelRule& rule) {
  return build_database(scene, {.page_size_bytes = 512, .structure = Structure::voxels, .voxels = rule});
}

/// Small balls at the ends of a cube's diagonal, and so many squares in its middle, one behind the other along x.
Scene squares(int count) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 0.01);
  builder.sphere({1, 1, 1}, 0.01);
  for (int i = 0; i < count; ++i) {
    const double x = 0.5 + 0.001 * i;
    builder.polygon({{x, 0.45, 0.45}, {x, 0.55, 0.45}, {x, 0.55, 0.55}, {x, 0.45, 0.55}});
  }
  return scene;
}

constexpr Vec3d along_x{1, 0, 0};

}  // namespace

TEST_CASE("in one voxel a ray reads its entry, then by turns a reference and the leaf that it names") {
  const Database database = voxels_of(squares(3), {.voxels_max = 1});
  const Walked walked = walk(database, ray_of(database, {-1, 0.5, 0.51}, along_x));
  CHECK(walked.traced == Traced::hit);
  CHECK(walked.look_ups == 1 + 5 * 2);
  CHECK(walked.operations.primitive_tests == std::array<std::uint64_t, 3>{6, 2, 0});
  CHECK(walked.operations.cell_steps == 1);
  CHECK(walked.operations.bvh_node_reads == 0);
  CHECK(database.sources()[walked.best.primitive].object == 2);
}

TEST_CASE("any hit ends a list, and what still waits in it counts as one") {
  const Database database = voxels_of(squares(3), {.voxels_max = 1, .follows_space = false});
  const Ray ray = ray_of(database, {-1, 0.5, 0.51}, along_x, RayKind::shadow);
  const Walked walked = walk(database, ray);
  CHECK(walked.traced == Traced::hit);
  CHECK(walked.look_ups == 1 + 3 * 2);  // two balls, and the first square
  CHECK(walked.operations.skipped.any_hit == 1);
  CHECK(walk(database, ray, false, {.any_hit = false}).look_ups == 1 + 5 * 2);
}

TEST_CASE("voxels without a list are one look-up and one step each, unless distances are known") {
  VoxelRule rule{.voxels_per_primitive = 500, .measures_empty_space = false};
  const Database plain = voxels_of(squares(0), rule);
  REQUIRE(macro_cells(plain.header().frame) == std::array<std::int32_t, 3>{10, 10, 10});
  const Walked walked = walk(plain, ray_of(plain, {-1, 0.5, 0.51}, along_x));
  CHECK(walked.traced == Traced::miss);
  CHECK(walked.look_ups == 10);
  CHECK(walked.operations.cell_steps == 10);
  CHECK(walked.operations.primitive_tests == std::array<std::uint64_t, 3>{});
  rule.measures_empty_space = true;
  const Database measured = voxels_of(squares(0), rule);
  const Ray ray = ray_of(measured, {-1, 0.5, 0.51}, along_x);
  const Walked jumped = walk(measured, ray);
  CHECK(jumped.look_ups < 10);
  CHECK(jumped.operations.empty_cells > 0);
}

TEST_CASE("a traversal through voxels that is interrupted at every record has the same bits and the same counts") {
  for (const char* name : {"balls-2", "tetra-3", "gears-1"}) {
    for (const VoxelRule& rule : {usual_voxels, article_voxels, VoxelRule{.voxels_max = 1}}) {
      CAPTURE(name);
      const Scene scene = built_in(name);
      const Database database = voxels_of(scene, rule);
      for (int i = 0; i < 20; ++i) {
        const Vec3d way = scene.view.at - scene.view.from + Vec3d{0.02 * i, -0.03 * i, 0.01 * i};
        const Ray ray = ray_of(database, scene.view.from, way, i % 2 == 0 ? RayKind::primary : RayKind::shadow);
        const Walked at_once = walk(database, ray), interrupted = walk(database, ray, true);
        CHECK(interrupted.interruptions == at_once.look_ups);
        CHECK(interrupted.look_ups == at_once.look_ups);
        CHECK(interrupted.traced == at_once.traced);
        CHECK(interrupted.best.t == at_once.best.t);
        CHECK(interrupted.best.primitive == at_once.best.primitive);
        CHECK(interrupted.operations.cell_steps == at_once.operations.cell_steps);
        CHECK(interrupted.operations.primitive_tests == at_once.operations.primitive_tests);
        CHECK(interrupted.operations.skipped.any_hit == at_once.operations.skipped.any_hit);
      }
    }
  }
}

}  // namespace voxel_traversal_test
