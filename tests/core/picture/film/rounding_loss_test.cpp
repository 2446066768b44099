#include "core/picture/film/rounding_loss.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/close_faces.h"
#include "tests/support/large_bodies.h"
#include "tests/support/small_scenes.h"

namespace rounding_loss_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Balls of radius 0.1 in rows that reach so far; the eye is next to the last one, under a leaning square.
Scene long_rows(double reach, double lean) {
  Scene scene;
  scene.view = {.from = {reach, -6, 2}, .at = {reach, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
  SceneBuilder builder(scene);
  builder.material({});
  for (int i = -8; i <= 8; ++i) {
    builder.sphere({reach * i / 8, 0, 0}, 0.1);
    builder.polygon({{reach * i / 8, 0, 1}, {reach * i / 8 + 1, 0, 1}, {reach * i / 8, 0, 2}});
  }
  builder.polygon({{-reach, -reach, -1 - reach * lean}, {reach, -reach, -1 - reach * lean}, {reach, reach, -1 + reach * lean}});
  return scene;
}

RoundingLoss loss_of(const Scene& scene, int pixels = 256) {
  const Database database = build_database(scene, {});
  return find_rounding_loss(database, Camera(scene.view, database.header().frame, pixels, pixels, 1));
}

Scene with_tiny_triangles(double size) {
  Scene scene = long_rows(1000, 0);
  SceneBuilder builder(scene);
  for (const double x : {0.0, 1000.0}) {
    for (int i = 1; i <= 3; ++i) {
      builder.polygon({{x, 1.0 * i, 0}, {x + size, 1.0 * i, 0}, {x, 1.0 * i, size}});
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("nothing is lost to rounding in a scene that is of a size with its details") {
  for (const char* name : {"balls-3", "gears-2", "mount-5", "rings-3", "shells-3", "teapot-5", "tree-6"}) {
    CAPTURE(std::string(name));
    CHECK(loss_of(built_in(name)).is_none());
  }
  CHECK(loss_of(long_rows(10, 0.1)).is_none());
}

TEST_CASE("what is small beside a scene and far from local zero is off, by so many pixels") {
  const RoundingLoss loss = loss_of(long_rows(1e5, 0));
  CHECK(loss.moved >= 1);
  CHECK(loss.moved_pixels > 0.05);
  CHECK(loss.moved_pixels < 1);
  const RoundingLoss finer = loss_of(long_rows(1e5, 0), 2560);
  CHECK(finer.moved_pixels / loss.moved_pixels == doctest::Approx(2559.0 / 255).epsilon(0.01));
}

TEST_CASE("a large plane that leans is off, even next to local zero") {
  const auto above_plane = [](double rise) {
    Scene scene = long_rows(1e-6, 0);
    SceneBuilder builder(scene);
    scene.view = {.from = {0, -6, 2}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
    const double h = 1e6;
    builder.polygon({{-h, -h, -rise * h}, {h, -h, -rise * h}, {h, h, rise * h}, {-h, h, rise * h}});
    return scene;
  };
  const RoundingLoss leaning = loss_of(above_plane(0.3));
  CHECK(leaning.moved == 2);
  CHECK(leaning.moved_pixels > 0.5);
  CHECK(loss_of(above_plane(0)).is_none());
}

TEST_CASE("a large body that passes by the detail is right until doubles cannot tell it, and then it is said") {
  for (const LargeBody body : {LargeBody::planet, LargeBody::pipe, LargeBody::mountain}) {
    CAPTURE(static_cast<int>(body));
    CHECK(loss_of(beside_large(body, 1e7), 96).is_none());
    const RoundingLoss loss = loss_of(beside_large(body, 1e12), 96);
    CHECK(loss.moved_pixels > 1);
  }
}

TEST_CASE("one that has detail on two sides is off where it is far from local zero, by so many pixels as it is large") {
  const auto two_sides = [](double radius) {
    Scene scene = beside_large(LargeBody::planet, radius);
    const Vec3d other_side = scene.spheres.back().center * 2.0;
    for (int i = 0; i < 8; ++i) {
      SceneBuilder(scene).sphere(other_side + Vec3d{0.7 * i, 0, 0}, 0.3);
    }
    return loss_of(scene, 96);
  };
  CHECK(two_sides(1e3).is_none());
  CHECK(two_sides(1e6).moved_pixels > 0.1);
  CHECK(two_sides(1e6).moved_pixels < 5);
}

TEST_CASE("what rounding leaves nothing of is counted, with its size in pixels") {
  const RoundingLoss loss = loss_of(with_tiny_triangles(2e-6));
  CHECK(loss.collapsed == 6);
  CHECK(loss.collapsed_pixels > 1e-5);
  CHECK(loss.collapsed_pixels < 1e-3);
  CHECK(build_database(with_tiny_triangles(2e-6), {}).dropped() == 6);
  CHECK(loss_of(with_tiny_triangles(0)).collapsed == 0);
  CHECK(build_database(with_tiny_triangles(0), {}).dropped() == 6);
}

TEST_CASE(
    "what no ray can tell from a point is left out, of every kind, though next to local zero floats can tell it from nothing") {
  const auto scene_of = [](double size) {
    Scene scene = long_rows(1e-6, 0);
    SceneBuilder builder(scene);
    builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    builder.polygon({{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    builder.sphere({0, 0, 0}, size / 2);
    builder.cone({0, 0, 0}, size / 2, {0, 0, size}, 0);
    return scene;
  };
  CHECK(build_database(scene_of(0x1p-38), {}).dropped() == 0);
  const Database database = build_database(scene_of(0x1p-41), {});
  CHECK(database.dropped() == 3);
  CHECK(database.collapsed().size() == 3);
}

TEST_CASE("faces whose order a ray cannot tell are counted, by how wide across they are; others next to each other are not") {
  CHECK(loss_of(poster_scene(turned_round, 1e-3, 0, false)).swapped == 0);
  CHECK(loss_of(poster_scene(turned_round, 1e-7, 0, false)).swapped == 0);
  const RoundingLoss cut = loss_of(poster_scene(turned_round, -5e-10, 1e-9, false));
  CHECK(cut.swapped > 0);
  CHECK(cut.swapped_pixels > 10);
  const RoundingLoss merged = loss_of(poster_scene(along_axes, 2e-12, 0, false));
  CHECK(merged.swapped > 0);
  CHECK(merged.swapped_pixels > 10);
}

}  // namespace rounding_loss_test
