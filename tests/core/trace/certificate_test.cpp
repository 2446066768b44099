#include "core/trace/certificate.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "apps/lab/bench/stability/rays.h"
#include "core/trace/primitive.h"

namespace certificate_test {

using namespace dmpc::core;
using dmpc::apps::ray_from;

namespace {

using Rows = std::vector<float>;

const Rows facing{0, 0, 1, 1, 0, 1, 0, 1, 1};

Certificate on_triangle(const Ray& ray, const Rows& rows = facing) {
  return certify(ray, PrimitiveKind::triangle, rows.data(), 1, 0);
}
Certificate on_sphere(const Ray& ray, float radius) {
  const Rows rows{0, 0, 3, radius, 0};
  return certify(ray, PrimitiveKind::sphere, rows.data(), 1, 0);
}
float hit_of(const Ray& ray, const Rows& rows = facing) { return intersect_triangle(ShearedRay(ray), rows.data(), 1, 0); }

TEST_CASE("a ray that meets a triangle at floats is certified to some 10^-16") {
  const Certificate certificate = on_triangle(ray_from({0.25F, 0.5F, 0}, {0, 0, 1}));
  CHECK(certificate.t.holds(1));
  CHECK(certificate.u.holds(0.25));
  CHECK(certificate.v.holds(0.5));
  CHECK(certificate.t.width() < 1e-15);
  CHECK(certificate.u.width() < 1e-15);
  CHECK(certificate.is_inside());
  CHECK(certificate.t_error < 16 * 0x1p-24);
}

TEST_CASE("the exact ray is the one with its rests") {
  Ray ray = ray_from({0.25F, 0.5F, 0}, {0, 0, 1});
  ray.origin_rest = {0x1p-30F, 0, 0x1p-40F};
  ray.direction_rest = {0, 0x1p-28F, 0};
  const Certificate certificate = on_triangle(ray);
  CHECK(certificate.t.holds(1 - 0x1p-40));
  CHECK_FALSE(certificate.t.holds(1));
  CHECK(certificate.u.holds(0.25 + 0x1p-30));
  CHECK_FALSE(certificate.u.holds(0.25));
  CHECK(certificate.v.holds(0.5 + 0x1p-28 * (1 - 0x1p-40)));
  CHECK_FALSE(certificate.v.holds(0.5));
  CHECK(std::fabs(double{hit_of(ray)} - (1 - 0x1p-40)) <= certificate.t_error);
}

TEST_CASE("on an edge, beside it and at a vertex nothing says that the ray is inside") {
  CHECK_FALSE(on_triangle(ray_from({-0x1p-30F, 0.5F, 0}, {0, 0, 1})).is_inside());
  CHECK(on_triangle(ray_from({0x1p-30F, 0.5F, 0}, {0, 0, 1})).is_inside());
}

TEST_CASE("a ray that doubles cannot tell from one in parallel with the plane is not certified") {
  const Certificate certificate = on_triangle(ray_from({0, 0, 1}, {1, 0, 0}));
  CHECK_FALSE(certificate.is_decided());
  CHECK_FALSE(certificate.is_inside());
  CHECK(std::isinf(certificate.t_error));
  CHECK_FALSE(on_triangle(ray_from({0, 0, 0}, {0, 0, 1}), {0, 0, 1, 1, 0, 1, 2, 0, 1}).is_decided());
}

TEST_CASE("rays and triangles beyond what bounds are derived for are not certified") {
  CHECK_FALSE(on_triangle(ray_from({0.25F, 0.5F, 0}, {0, 0, 1e-35F})).is_decided());
  CHECK_FALSE(on_triangle(ray_from({0.25F, 0.5F, -1e15F}, {0, 0, 1})).is_decided());
  CHECK_FALSE(on_triangle(ray_from({0.25F, 0.5F, 0}, {0, 0, std::numeric_limits<float>::quiet_NaN()})).is_decided());
}

TEST_CASE("on a sliver the bound of floats is wide and the interval is not") {
  const Rows sliver{0, 0, 1, 1, 0, 2, 0.5F, 1e-5F, 1.5F};
  const Ray ray = ray_from({0.4F, 4e-6F, -1}, {0, 0, 1});
  const Certificate certificate = on_triangle(ray, sliver);
  CHECK(certificate.t.width() < 1e-10);
  CHECK(certificate.t_error > 1e-6);
  CHECK(std::fabs(double{hit_of(ray, sliver)} - certificate.t.low) <= certificate.t_error);
}

TEST_CASE("a sphere is certified where it is entered, and where it is left from within or shows its inside only") {
  const Ray ray = ray_from({0, 0, 0}, {0, 0, 1});
  CHECK(on_sphere(ray, 1).t.holds(2));
  CHECK(on_sphere(ray, 1).t.width() < 1e-14);
  CHECK(on_sphere(ray, -1).t.holds(4));
  CHECK(on_sphere(ray_from({0, 0, 2.5F}, {0, 0, 1}), 1).t.holds(1.5));
  CHECK(on_sphere(ray, 1).t_error < 2.01 * 0x1p-24);
}

TEST_CASE("a tangent of a sphere, a ray that starts on it, and one that misses it are not certified") {
  CHECK_FALSE(on_sphere(ray_from({1, 0, 0}, {0, 0, 1}), 1).is_decided());
  CHECK_FALSE(on_sphere(ray_from({0, 0, 2}, {0, 0, 1}), 1).is_decided());
  CHECK_FALSE(on_sphere(ray_from({2, 0, 0}, {0, 0, 1}), 1).is_decided());
}

/// About the z axis from z = 3 to 4.
Certificate on_cone(const Ray& ray, float base_radius, float apex_radius) {
  const Rows rows{0, 0, 3, base_radius, 0, 0, 4, apex_radius, 0, 0};
  return certify(ray, PrimitiveKind::cone, rows.data(), 1, 0);
}

TEST_CASE("cones and cylinders are certified where they are entered, and where only the inside is visible left") {
  const Ray across = ray_from({0, -3, 3.5F}, {0, 1, 0});
  CHECK(on_cone(across, 1, 1).t.holds(2));
  CHECK(on_cone(across, 1, 1).t.width() < 1e-14);
  CHECK(on_cone(across, -1, -1).t.holds(4));
  CHECK(on_cone(across, 1, 0).t.holds(2.5));
  CHECK(on_cone(across, 1, 1).t_error < 2.01 * 0x1p-24);
}

TEST_CASE("a cone that is entered by an open end is certified where it is left") {
  CHECK(on_cone(ray_from({0, 0, 0}, {0, 0.125F, 1}), 0.4375F, 0.4375F).t.holds(3.5));
}

TEST_CASE("a tangent of a cone, and what passes between its ends, are not certified") {
  CHECK_FALSE(on_cone(ray_from({1, -3, 3.5F}, {0, 1, 0}), 1, 1).is_decided());
  CHECK_FALSE(on_cone(ray_from({0, -3, 5}, {0, 1, 0}), 1, 1).is_decided());
  CHECK_FALSE(on_cone(ray_from({0, 0, 0}, {0, 0.125F, 1}), 1, 1).is_decided());
}

}  // namespace

}  // namespace certificate_test
