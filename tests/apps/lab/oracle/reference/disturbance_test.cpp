#include "apps/lab/oracle/reference/disturbance.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace dmpc::tests::disturbance_test {
namespace {

using apps::Disturbance;
using apps::ReferenceBody;
using apps::ReferenceRay;
using core::Vec3d;

const ReferenceBody ball{.kind = core::PrimitiveKind::sphere, .place = {Vec3d{0, 0, 0}}, .radius = {1}};

ReferenceRay child(core::RayKind kind) { return {.origin = {0, 0, 1}, .direction = {0, 0.6, 0.8}, .depth = 2, .kind = kind}; }

/// Touches the ball's top and shoots a child from there.
ReferenceRay disturbed(std::uint64_t seed, ReferenceRay ray) {
  const ReferenceRay down{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
  apps::ReferenceSurface surface = surface_at(ball, down, 2);
  Disturbance disturbance(1, seed);
  disturbance.touch(down, ball, surface);
  CHECK(length(surface.point - Vec3d{0, 0, 1}) < 1e-6);
  disturbance.shoot(ray);
  return ray;
}

TEST_CASE("a disturbance moves a ray by some roundings and never to the wrong side of its surface") {
  double farthest = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const ReferenceRay ray = disturbed(seed, child(core::RayKind::reflected));
    REQUIRE(ray.origin.z > 1);
    REQUIRE(length(ray.origin - Vec3d{0, 0, 1}) < 4e-6);
    REQUIRE(length(ray.direction) == doctest::Approx(1).epsilon(1e-14));
    farthest = std::max(farthest, length(ray.direction - Vec3d{0, 0.6, 0.8}));
  }
  CHECK(farthest > 1e-15);
  CHECK(farthest < 1e-12);
}

TEST_CASE("glass turns a ray that starts inside by the rounding of its index, too") {
  ReferenceRay inwards = child(core::RayKind::refracted);
  inwards.direction.z = -0.8;
  double farthest = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const ReferenceRay ray = disturbed(seed, inwards);
    REQUIRE(ray.origin.z < 1);
    farthest = std::max(farthest, length(ray.direction - inwards.direction));
  }
  CHECK(farthest > 1e-7);
  CHECK(farthest < 6e-7);
}

TEST_CASE("a shadow ray still ends at its light") {
  ReferenceRay ray = child(core::RayKind::shadow);
  ray.depth = 1;
  ray.t_max = 10;
  const ReferenceRay moved = disturbed(3, ray);
  CHECK(length(moved.origin + moved.direction * moved.t_max - (ray.origin + ray.direction * ray.t_max)) < 1e-5);
}

TEST_CASE("one seed disturbs alike and another one otherwise") {
  const ReferenceRay ray = child(core::RayKind::reflected);
  CHECK(disturbed(1, ray).direction == disturbed(1, ray).direction);
  CHECK(disturbed(1, ray).direction != disturbed(2, ray).direction);
}

TEST_CASE("a small triangle turns by more than a large one") {
  double small = 0, large = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (const double size : {1.0, 1e-3}) {
      const ReferenceBody triangle{.kind = core::PrimitiveKind::triangle,
                                   .place = {Vec3d{0, 0, 0}, Vec3d{size, 0, 0}, Vec3d{0, size, 0}}};
      const ReferenceRay down{.origin = {size / 3, size / 3, 1}, .direction = {0, 0, -1}};
      apps::ReferenceSurface surface = surface_at(triangle, down, 1);
      Disturbance(1, seed).touch(down, triangle, surface);
      double& turned = size < 1 ? small : large;
      turned = std::max(turned, length(surface.normal - Vec3d{0, 0, 1}));
    }
  }
  CHECK(small > 100 * large);
  CHECK(small < 1e-3);
}

}  // namespace
}  // namespace dmpc::tests::disturbance_test
