#include "apps/lab/oracle/reference/camera.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/expect.h"
#include "core/picture/camera/camera.h"

namespace dmpc::tests::reference_camera_test {
namespace {

using core::Vec3d;

const core::View view{.from = {3, -4, 2}, .at = {0, 0.5, 0.1}, .up = {0, 0.1, 1}, .angle_degrees = 40};

TEST_CASE("the ray through the middle looks where the view looks") {
  const apps::ReferenceRay ray = apps::ReferenceCamera(view, 5, 3).ray_through(2, 1);
  CHECK(ray.origin == view.from);
  CHECK(length(ray.direction - normalize(view.at - view.from)) < 1e-15);
}

TEST_CASE("the angle spans the centres of the first and the last row") {
  const apps::ReferenceCamera camera(view, 8, 5);
  const double cosine = dot(camera.ray_through(3.5, 0).direction, camera.ray_through(3.5, 4).direction);
  CHECK(std::acos(cosine) * 180 / std::acos(-1.0) == doctest::Approx(40).epsilon(1e-12));
}

TEST_CASE("rays are those of the product but for its rounding") {
  const apps::ReferenceCamera camera(view, 12, 7);
  const core::GridFrame frame{.origin = {-2, -2, -2}, .scale = 0.25};
  const core::Camera product(view, frame, 12, 7, 1);
  for (std::uint32_t pixel = 0; pixel < 84; ++pixel) {
    const Vec3d expected(product.primary_ray(pixel, 0).direction);
    CHECK(length(camera.ray_through(pixel % 12, pixel / 12).direction - expected) < 1e-7);
  }
}

TEST_CASE("rays of an eye that is far from what it sees start before that, as near to their lines as double can tell there") {
  const core::View far{.from = {7e8, 0, 0}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 1e-7};
  const core::Box seen{{-1, -1, -1}, {1, 1, 1}};
  const apps::ReferenceCamera camera(far, 9, 9, seen);
  const apps::ReferenceRay ray = camera.ray_through(8, 4);
  CHECK(ray.origin.x < 8);
  CHECK(ray.cone == doctest::Approx(7e8).epsilon(1e-8));
  const double across = std::tan(0.5e-7 * std::acos(-1.0) / 180) * (7e8 - ray.origin.x);
  CHECK(std::fabs(std::fabs(ray.origin.y) - across) < 1e-15);
  CHECK(length(camera.start()) < 8);
  CHECK(apps::ReferenceCamera(view, 9, 9, seen).ray_through(8, 4).origin == view.from);
}

TEST_CASE("a picture of one pixel looks straight ahead and one of none is refused") {
  CHECK(length(apps::ReferenceCamera(view, 1, 1).ray_through(0, 0).direction - normalize(view.at - view.from)) < 1e-15);
  CHECK_THROWS_AS(apps::ReferenceCamera(view, 0, 1), core::InternalError);
}

}  // namespace
}  // namespace dmpc::tests::reference_camera_test
