#include "core/scene/detail.h"

#include <doctest/doctest.h>

#include <string>

#include "core/database/database.h"
#include "core/scene/frame.h"
#include "tests/support/small_scenes.h"

namespace detail_test {

using namespace dmpc::core;
using dmpc::tests::built_in;

namespace {

/// A square of half side `half` below eight balls of radius 0.5 about `place`.
Scene balls_on_square(double half, const Vec3d& place) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({});
  builder.polygon({{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}});
  for (int i = 0; i < 8; ++i) {
    builder.sphere(place + Vec3d{i % 2 * 2.0, i / 2 % 2 * 2.0, i / 4 * 2.0}, 0.5);
  }
  return scene;
}

GridFrame frame_of(const Scene& scene) { return build_database(scene, {}).header().frame; }

}  // namespace

TEST_CASE("local zero lies where detail is close together beside something large") {
  for (const Vec3d& place : {Vec3d{0, 0, 1}, Vec3d{700, -900, 3}}) {
    const GridFrame frame = frame_of(balls_on_square(1000, place));
    CHECK(length(to_local(frame, place)) < 4 * frame.scale);
    CHECK(frame.low.x < 0);
    CHECK(to_local(frame, {-1000, -1000, 0}).x > frame.low.x);
  }
}

TEST_CASE("detail that is close together is found wherever it lies") {
  for (int i = 0; i < 60; ++i) {  // in steps of less than detail's reach, which is 7.8 here
    const Vec3d place{-950 + i * 5.7, 900 - i * 7.1, 3};
    const GridFrame frame = frame_of(balls_on_square(1000, place));
    CAPTURE(i);
    CHECK(length(to_local(frame, place)) < 4 * frame.scale);
  }
}

TEST_CASE("local zero is where the grid begins if detail is spread over the scene") {
  for (const std::string name : {"balls", "gears", "jacks", "lattice", "mount", "rings", "sombrero", "teapot", "tetra", "tree"}) {
    CAPTURE(name);
    CHECK(frame_of(built_in(name)).low == Vec3d{});
  }
  CHECK(frame_of(balls_on_square(100, {0, 0, 1})).low == Vec3d{});
}

TEST_CASE("where local zero lies scales by powers of two with the scene") {
  Scene scene = balls_on_square(1000, {700, -900, 3});
  const GridFrame frame = frame_of(scene);
  for (Vec3d& vertex : scene.vertices) {
    vertex = vertex * 0x1p40;
  }
  for (Sphere& sphere : scene.spheres) {
    sphere = {sphere.center * 0x1p40, sphere.radius * 0x1p40};
  }
  const GridFrame larger = frame_of(scene);
  CHECK(larger.origin == frame.origin * 0x1p40);
  CHECK(larger.low == frame.low);
}

TEST_CASE("what has no size is no detail") {
  Scene scene = balls_on_square(10, {0, 0, 1});
  SceneBuilder builder(scene);
  for (int i = 0; i < 100; ++i) {
    builder.polygon({{3, 3, 3}, {3, 3, 3}, {3, 3, 3}});
    builder.sphere({-3, 3, 3}, 0);
  }
  CHECK(frame_of(scene).low == Vec3d{});
  CHECK(frame_of(Scene{}).low == Vec3d{});
}

}  // namespace detail_test
