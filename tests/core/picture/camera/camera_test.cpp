#include "core/picture/camera/camera.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace picture_camera_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Looks along -z from z = 1 with y up, through a frame that changes nothing.
const View straight{.from = {0, 0, 1}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 60};

/// Where a primary ray meets the plane at distance 1: x to the right, y up.
std::pair<double, double> place(const Camera& camera, std::uint32_t pixel, std::uint32_t sample = 0) {
  const Vec3d d(camera.primary_ray(pixel, sample).direction);
  return {d.x / -d.z, d.y / -d.z};
}

const double reach = tan_degrees(30);

}  // namespace

TEST_CASE("the angle spans the centres of the first and the last pixel") {
  const Camera camera(straight, {}, 5, 5, 1);
  const auto [left, top] = place(camera, 0);
  const auto [right, bottom] = place(camera, 24);
  CHECK(left == doctest::Approx(-reach).epsilon(1e-6));
  CHECK(top == doctest::Approx(reach).epsilon(1e-6));
  CHECK(right == doctest::Approx(reach).epsilon(1e-6));
  CHECK(bottom == doctest::Approx(-reach).epsilon(1e-6));
}

TEST_CASE("pixel i of n lies at 2 i / (n - 1) - 1 of the half angle's tangent") {
  const int n = 8;
  const Camera camera(straight, {}, n, n, 1);
  for (std::uint32_t i = 0; i < 8; ++i) {
    CHECK(place(camera, i).first == doctest::Approx(reach * (2.0 * i / (n - 1) - 1)).epsilon(1e-6));
  }
}

TEST_CASE("the middle ray of an odd picture goes straight ahead") {
  const Ray ray = Camera(straight, {}, 3, 3, 1).primary_ray(4, 0);
  CHECK(ray.direction == Vec3f{0, 0, -1});
  CHECK(ray.origin == Vec3f{0, 0, 1});
}

TEST_CASE("a pixel off the middle is seen under less of an angle, outwards by the square of its cosine") {
  const View right_angle{.from = {0, 0, 1}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 90};
  const Camera camera(right_angle, {}, 3, 3, 1);
  CHECK(camera.square_cosine(4) == doctest::Approx(1));
  CHECK(camera.square_cosine(3) == doctest::Approx(1.0 / 2));
  CHECK(camera.square_cosine(0) == doctest::Approx(1.0 / 3));
}

TEST_CASE("the angle belongs to the shorter side, and pixels are square") {
  const Camera camera(straight, {}, 9, 5, 1);
  CHECK(place(camera, 0).second == doctest::Approx(reach).epsilon(1e-6));
  CHECK(place(camera, 0).first == doctest::Approx(-2 * reach).epsilon(1e-6));
}

TEST_CASE("primary rays are of unit length and carry their pixel and sample") {
  const Camera camera(straight, {}, 7, 5, 4);
  for (std::uint32_t pixel = 0; pixel < camera.pixel_count(); ++pixel) {
    const Ray ray = camera.primary_ray(pixel, 3);
    CHECK(length(Vec3d(ray.direction)) == doctest::Approx(1).epsilon(1e-6));
    CHECK(ray.pixel == pixel);
    CHECK(ray.sample == 3);
    CHECK(ray.depth == 1);
    CHECK(ray.kind == RayKind::primary);
  }
}

TEST_CASE("samples stay inside their pixel and fill it") {
  const Camera camera(straight, {}, 5, 5, 1000);
  const double pixel = 2 * reach / 4;
  double left = 1, right = -1;
  for (std::uint32_t sample = 0; sample < 1000; ++sample) {
    const auto [x, y] = place(camera, 12, sample);
    CHECK(std::fabs(x) <= pixel / 2 * (1 + 1e-6));
    CHECK(std::fabs(y) <= pixel / 2 * (1 + 1e-6));
    left = std::min(left, x);
    right = std::max(right, x);
  }
  CHECK(left < -0.49 * pixel);
  CHECK(right > 0.49 * pixel);
}

TEST_CASE("a camera's frame moves its origin and not its directions") {
  const GridFrame frame{.origin = {-4, -4, -4}, .scale = 0.125};
  const Ray ray = Camera(straight, frame, 3, 3, 1).primary_ray(0, 0), plain = Camera(straight, {}, 3, 3, 1).primary_ray(0, 0);
  CHECK(ray.origin == Vec3f{0.5F, 0.5F, 0.625F});
  CHECK(ray.direction == plain.direction);
}

TEST_CASE("a picture of one pixel looks straight ahead, one of none is refused") {
  CHECK(Camera(straight, {}, 1, 1, 1).primary_ray(0, 0).direction == Vec3f{0, 0, -1});
  CHECK_THROWS_AS(Camera(straight, {}, 0, 1, 1), InternalError);
  CHECK_THROWS_AS(Camera(straight, {}, 1, 1, 0), InternalError);
}

TEST_CASE("rays of an eye far away start beside the grid and lead where those of the eye do") {
  const GridFrame frame{.resolution = {8, 8, 8}, .finest_cell = 1.0F / (8 * finest_per_cell)};
  const Vec3d middle{0.5, 0.5, 0.5};
  for (const double distance : {2.0, 1e4, 1e8}) {
    const View view{.from = middle + Vec3d{0, 0, distance}, .at = middle, .up = {0, 1, 0}, .angle_degrees = 114 / distance};
    const Camera camera(view, frame, 5, 5, 1);
    for (std::uint32_t pixel = 0; pixel < 25; ++pixel) {
      const Ray ray = camera.primary_ray(pixel, 0);
      const Vec3d start = ray.full_origin(), towards = ray.full_direction();
      CHECK(length(start - middle) < (distance < 4 ? 2.1 : 4));
      const Vec3d at = start + towards * ((0.5 - start.z) / towards.z);
      const double pixel_step = 2 * distance * tan_degrees(57 / distance) / 4;
      CHECK(std::fabs(at.x - (0.5 + (static_cast<double>(pixel % 5) - 2) * pixel_step)) < 1e-7);
      CHECK(std::fabs(at.y - (0.5 - (static_cast<double>(pixel / 5) - 2) * pixel_step)) < 1e-7);
    }
  }
}

}  // namespace picture_camera_test
