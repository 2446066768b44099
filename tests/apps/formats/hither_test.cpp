#include "apps/formats/hither.h"

#include <doctest/doctest.h>

namespace dmpc::apps::hither_test {

using core::Vec3d;

namespace {

/// An eye at the origin that looks along x with a right angle, and a hither plane at distance 1.
core::Scene looking_along_x(double hither = 1) {
  core::Scene scene;
  scene.name = "a.nff";
  scene.view = {
      .from = {0, 0, 0}, .at = {1, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 90, .hither = hither, .width = 64, .height = 64};
  core::SceneBuilder builder(scene);
  builder.material({});
  return scene;
}

std::uint64_t count_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  core::Scene scene = looking_along_x();
  core::SceneBuilder(scene).polygon({a, b, c});
  return objects_before_hither(scene);
}

std::uint64_t count_of(const Vec3d& center, double radius) {
  core::Scene scene = looking_along_x();
  core::SceneBuilder(scene).sphere(center, radius);
  return objects_before_hither(scene);
}

}  // namespace

TEST_CASE("what shows in view before the hither plane is counted") {
  CHECK(count_of({0.5, -0.1, -0.1}, {0.5, 0.1, -0.1}, {0.5, 0, 0.1}) == 1);
  CHECK(count_of({0.5, 0, -0.1}, {9, 1, 0}, {9, -1, 0}) == 1);
  CHECK(count_of({0.5, 0, 0}, 0.1) == 1);
  CHECK(count_of({2, 0, 0}, 1.5) == 1);
}

TEST_CASE("what lies behind the plane, behind the eye or beside the view is not") {
  CHECK(count_of({1.5, -0.1, -0.1}, {1.5, 0.1, -0.1}, {1.5, 0, 0.1}) == 0);
  CHECK(count_of({-0.5, -0.1, -0.1}, {-0.5, 0.1, -0.1}, {-0.5, 0, 0.1}) == 0);
  CHECK(count_of({-50, -50, -2}, {50, -50, -2}, {0, 50, -2}) == 0);  // a floor, which comes into view behind the plane
  CHECK(count_of({3, 0, 0}, 1.5) == 0);
  CHECK(count_of({0.5, 5, 0}, 0.5) == 0);
}

TEST_CASE("what the hither distance would have hidden is said, and else nothing") {
  core::Scene scene = looking_along_x(0.75);
  core::SceneBuilder builder(scene);
  builder.cone({0.5, 0, -0.1}, 0.1, {0.5, 0, 0.1}, 0.1);
  builder.sphere({5, 0, 0}, 1);
  CHECK(hither_note(scene) ==
        "a.nff: hither 0.75 of v (view) is read and ignored: the picture shows 1 object of which all or a part is nearer to the "
        "eye "
        "than that");
  scene.view.hither = 0;
  CHECK(hither_note(scene).empty());
}

}  // namespace dmpc::apps::hither_test
