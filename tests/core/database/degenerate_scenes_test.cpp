// Scenes that are empty, of one piece, all in one place or in two places far apart.
#include <doctest/doctest.h>

#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace degenerate_scenes_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// Rays through a scene's bounds that hit something else than brute force says, of `count`.
std::size_t differences(const Database& database, std::size_t count) {
  const GridFrame& frame = database.header().frame;
  Random random(31);
  std::size_t different = 0;
  const auto anywhere = [&] {
    Vec3d at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = plane_at(frame, axis, 0) +
                 random.between(-0.5, 1.5) * frame.resolution[axis] * double{frame.finest_cell} * finest_per_cell;
    }
    return at;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = anywhere();
    const auto& primitives = database.primitives();
    const Vec3d target = i % 2 == 0 || primitives.empty() ? anywhere() : primitives[random.below(primitives.size())].vector(0);
    const Ray ray = ray_through(from, target);
    different += same_hit(shoot(database, ray), brute_force(database, ray)) ? 0 : 1;
  }
  return different;
}

/// What a primitive of an ordinary scene of random triangles costs.
double ordinary_bytes_per_primitive(std::size_t count) {
  Random random(32);
  Scene scene;
  SceneBuilder builder(scene);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d at = random.in_box(-1, 1);
    builder.polygon({at, at + random.in_box(-0.02, 0.02), at + random.in_box(-0.02, 0.02)});
  }
  return static_cast<double>(database_of(scene).bytes().size()) / static_cast<double>(count);
}

double bytes_per_primitive(const Database& database) {
  return static_cast<double>(database.bytes().size()) / static_cast<double>(database.primitives().size());
}

Scene coincident(std::size_t count, const Mesh& mesh) {
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    add(scene, moved(mesh, 1 - 1e-6 * static_cast<double>(i), {0, 0, 0}));  // equal ones would be kept once
  }
  return scene;
}

}  // namespace

TEST_CASE("an empty scene is a page that every ray misses") {
  const Database database = database_of({});
  CHECK(database.page_count() == 1);
  CHECK(database.primitives().empty());
  CHECK(differences(database, scaled(1000)) == 0);
  CHECK_FALSE(shoot(database, ray_from({0.5F, 0.5F, 0.5F}, {1, 0, 0})).found());
}

TEST_CASE("a scene of one triangle is hit where the triangle is") {
  const Database database = database_of(scene_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  const GridFrame& frame = database.header().frame;
  CHECK(shoot(database, ray_through(to_local(frame, {0.3, 0.3, 5}), to_local(frame, {0.3, 0.3, 0}))).found());
  CHECK_FALSE(shoot(database, ray_through(to_local(frame, {0.6, 0.6, 5}), to_local(frame, {0.6, 0.6, 0}))).found());
  CHECK(differences(database, scaled(20'000)) == 0);
}

TEST_CASE("a scene of one point-like sphere is hit") {
  Scene scene;
  SceneBuilder(scene).sphere({3, 4, 5}, 1e-12);
  const Database database = database_of(scene);
  const Vec3d center = to_local(database.header().frame, {3, 4, 5});
  CHECK(shoot(database, ray_through(center + Vec3d{1, 1, 1}, center)).found());
}

TEST_CASE("thousands of triangles in one place cost no more than elsewhere" * doctest::test_suite("slow")) {
  const std::size_t count = scaled(40'000);
  const Database flat = database_of(coincident(count, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  const Database slanted = database_of(coincident(count, {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  const double ordinary = ordinary_bytes_per_primitive(count);
  for (const Database* database : {&flat, &slanted}) {
    CHECK(database->primitives().size() == count);
    CHECK(bytes_per_primitive(*database) < 4 * ordinary);
    const GridFrame& frame = database->header().frame;
    const Hit hit = shoot(*database, ray_through(to_local(frame, {0.2, 0.2, 3}), to_local(frame, {0.3, 0.3, 0.4})));
    CHECK(hit.found());
    CHECK(hit.primitive == 0);
  }
}

TEST_CASE("two clusters a million apart are hit as brute force says") {
  Random random(33);
  Scene scene;
  for (const double x : {0.0, 1e6}) {
    for (std::size_t i = 0; i < 500; ++i) {
      add(scene, moved(tetrahedron(), 0.05, Vec3d{x, 0, 0} + random.in_box(-1, 1)));
    }
  }
  const Database database = database_of(scene);
  CHECK(differences(database, scaled(2000)) == 0);
  CHECK(static_cast<double>(database.bytes().size()) / static_cast<double>(database.primitives().size() + database.dropped()) <
        4 * ordinary_bytes_per_primitive(4000));
}

TEST_CASE("many triangles as long as the scene need little more than their number") {
  Random random(34);
  Scene scene;
  SceneBuilder builder(scene);
  const std::size_t count = scaled(2000);
  for (std::size_t i = 0; i < count; ++i) {
    builder.polygon({random.direction(), random.direction(), random.direction()});
  }
  const Database database = database_of(scene);
  CHECK(differences(database, scaled(1000)) == 0);
  MESSAGE(bytes_per_primitive(database), " bytes a triangle");
}

TEST_CASE("a view from far away makes a database slower, not larger") {
  const Scene scene = scene_of(sphere_mesh(40, 60, 0));
  const Database near = database_of(seen_from(scene, 1)), far = database_of(seen_from(scene, 1e6));
  CHECK(far.bytes().size() < 4 * near.bytes().size());
  CHECK(differences(far, scaled(200)) == 0);
}

}  // namespace degenerate_scenes_test
