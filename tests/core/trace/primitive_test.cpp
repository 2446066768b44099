#include "core/trace/primitive.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "core/record/curved_values.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace primitive_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

using Rows = std::vector<float>;

float triangle(const Rows& rows, const Ray& ray) { return intersect_triangle(ShearedRay(ray), rows.data(), 1, 0); }
/// Values without rests.
float sphere(Rows rows, const Ray& ray) {
  rows.resize(value_count(PrimitiveKind::sphere));
  return intersect_sphere(ray, rows.data(), 1, 0);
}
float cone(Rows rows, const Ray& ray) {
  rows.resize(value_count(PrimitiveKind::cone));
  return intersect_cone(ray, rows.data(), 1, 0);
}

const Rows right_triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
const Rows unit_sphere{0, 0, 0, 1}, hollow_sphere{0, 0, 0, -1};
const Rows cylinder{0, 0, 0, 1, 0, 0, 2, 1}, hollow_cylinder{0, 0, 0, -1, 0, 0, 2, -1};
const Rows pointed{0, 0, 0, 1, 0, 0, 1, 0};

bool misses(float t) { return !(t > 0.0F); }

}  // namespace

TEST_CASE("a triangle is hit at its distance from both sides") {
  CHECK(triangle(right_triangle, ray_from({0.25F, 0.25F, 3}, {0, 0, -1})) == 3.0F);
  CHECK(triangle(right_triangle, ray_from({0.25F, 0.25F, -2}, {0, 0, 1})) == 2.0F);
  CHECK(misses(triangle(right_triangle, ray_from({0.75F, 0.75F, 3}, {0, 0, -1}))));
  CHECK(misses(triangle(right_triangle, ray_from({0.25F, 0.25F, 3}, {0, 0, 1}))));
}

TEST_CASE("a triangle's edges and vertices belong to it") {
  for (const Vec3f& at :
       {Vec3f{0, 0, 1}, Vec3f{1, 0, 1}, Vec3f{0, 1, 1}, Vec3f{0.5F, 0, 1}, Vec3f{0, 0.5F, 1}, Vec3f{0.5F, 0.5F, 1}}) {
    CHECK(triangle(right_triangle, ray_from(at, {0, 0, -1})) == 1.0F);
  }
}

TEST_CASE("a ray beside an edge by less than single precision resolves meets exactly one of two neighbours") {
  const float e = 0x1p-23F;  // both products of the edge function round to the same, their difference is e squared
  const Vec3f c{1 + 3 * e, 1 + 2 * e, 1}, b{-(1 + 2 * e), -(1 + e), 1};
  const Ray ray = ray_from({0, 0, 0}, {0, 0, 1});
  CHECK(misses(triangle({-1, 1, 1, b.x, b.y, b.z, c.x, c.y, c.z}, ray)));
  CHECK(triangle({1, -1, 1, b.x, b.y, b.z, c.x, c.y, c.z}, ray) == 1.0F);
}

TEST_CASE("a triangle seen edge-on or without area is missed") {
  CHECK(misses(triangle(right_triangle, ray_from({-1, 0.25F, 0}, {1, 0, 0}))));
  CHECK(misses(triangle({0, 0, 0, 1, 1, 0, 2, 2, 0}, ray_from({1, 1, 1}, {0, 0, -1}))));
  CHECK(misses(triangle({0, 0, 0, 0, 0, 0, 0, 0, 0}, ray_from({0, 0, 1}, {0, 0, -1}))));
}

TEST_CASE("a ray that all but lies in a triangle's plane meets it no farther than it reaches") {
  const float low = 0.00809230097F, middle = 0.133092299F;  // the ray runs along an edge, from one of its ends
  const float t = triangle({0.383092314F, 0.258092314F, middle, low, low, low, middle, low, low},
                           ray_from({middle, low, low}, {-1, 9e-19F, 9e-19F}));
  CHECK(t <= middle - low);
}

TEST_CASE("scaling a triangle and the origin by a power of two scales t exactly, but next to the start, where doubles judge") {
  Random random(1);
  std::size_t differences = 0, hits = 0;
  for (std::size_t i = 0; i < scaled(20'000); ++i) {
    Rows rows;
    while (rows.size() < 9) {
      rows.push_back(static_cast<float>(random.between(-1, 1)));
    }
    const Ray ray = ray_from(Vec3f(random.in_box(-1, 1)), Vec3f(random.direction()));
    const float t = triangle(rows, ray);
    for (const int exponent : {-5, -2, 10, 40}) {
      const float factor = std::ldexp(1.0F, exponent);
      Rows larger = rows;
      for (float& value : larger) {
        value *= factor;
      }
      const float other = triangle(larger, ray_from(ray.origin * factor, ray.direction));
      const bool is_judged = std::fabs(t) < near_start || std::fabs(other) < near_start;
      differences += is_judged || (misses(t) ? misses(other) : other == t * factor) ? 0 : 1;
    }
    hits += misses(t) ? 0 : 1;
  }
  CHECK(differences == 0);
  CHECK(hits > 0);
}

TEST_CASE("a sphere is hit outside, inside, and at its tangent") {
  CHECK(sphere(unit_sphere, ray_from({0, 0, 3}, {0, 0, -1})) == 2.0F);
  CHECK(sphere(unit_sphere, ray_from({0, 0, 0}, {0, 0, -1})) == 1.0F);
  CHECK(sphere(unit_sphere, ray_from({0.5F, 0, 0}, {1, 0, 0})) == 0.5F);
  CHECK(sphere(unit_sphere, ray_from({1, 0, 3}, {0, 0, -1})) == 3.0F);
  CHECK(misses(sphere(unit_sphere, ray_from({1.0001F, 0, 3}, {0, 0, -1}))));
  CHECK(misses(sphere(unit_sphere, ray_from({0, 0, 3}, {0, 0, 1}))));
}

TEST_CASE("a negative radius shows a sphere's inside only") {
  CHECK(sphere(hollow_sphere, ray_from({0, 0, 3}, {0, 0, -1})) == 4.0F);
  CHECK(sphere(hollow_sphere, ray_from({0, 0, 0}, {0, 0, -1})) == 1.0F);
}

TEST_CASE("a small sphere far away is hit where it is") {
  const double gap = 1e-4 + 1e-9;
  CHECK(sphere({0, 0, -1000, 1e-4F}, ray_from({0, 0, 0}, {0, 0, -1})) == doctest::Approx(1000 - 1e-4).epsilon(1e-7));
  CHECK(misses(sphere({static_cast<float>(gap), 0, -1000, 1e-4F}, ray_from({0, 0, 0}, {0, 0, -1}))));
  CHECK_FALSE(misses(sphere({static_cast<float>(1e-4 - 1e-9), 0, -1000, 1e-4F}, ray_from({0, 0, 0}, {0, 0, -1}))));
}

TEST_CASE("a cylinder is hit outside and inside, and is open") {
  CHECK(cone(cylinder, ray_from({3, 0, 1}, {-1, 0, 0})) == 2.0F);
  CHECK(cone(cylinder, ray_from({0, 0, 1}, {-1, 0, 0})) == 1.0F);
  CHECK(misses(cone(cylinder, ray_from({3, 0, 2.5F}, {-1, 0, 0}))));
  CHECK(misses(cone(cylinder, ray_from({0, 0, 5}, {0, 0, -1}))));
  CHECK(misses(cone(cylinder, ray_from({0.5F, 0.5F, 5}, {0, 0, -1}))));
}

TEST_CASE("a ray into a cylinder's mouth meets its inside") {
  const Ray ray = ray_from({0, 0, 3}, Vec3f(normalize(Vec3d{1, 0, -2})));
  CHECK(cone(cylinder, ray) == doctest::Approx(std::sqrt(5.0)).epsilon(1e-6));
}

TEST_CASE("negative radii show a cylinder's inside only") {
  CHECK(cone(hollow_cylinder, ray_from({3, 0, 1}, {-1, 0, 0})) == 4.0F);
  CHECK(cone(hollow_cylinder, ray_from({0, 0, 1}, {-1, 0, 0})) == 1.0F);
}

TEST_CASE("a cone narrows to its apex and has no twin beyond it") {
  CHECK(cone(pointed, ray_from({3, 0, 0.5F}, {-1, 0, 0})) == 2.5F);
  CHECK(misses(cone(pointed, ray_from({3, 0, 1.5F}, {-1, 0, 0}))));
  CHECK(cone(pointed, ray_from({0.5F, 0, 3}, {0, 0, -1})) == 2.5F);
}

TEST_CASE("a ray along a cone's side or along a cylinder's axis ends in no error") {
  const float beside = cone(pointed, ray_from({2, 0, -1}, Vec3f(normalize(Vec3d{-1, 0, 1}))));
  CHECK((misses(beside) || std::isfinite(beside)));
  CHECK(misses(cone(cylinder, ray_from({0, 0, 1}, {0, 0, 1}))));
}

TEST_CASE("hits on cones lie on their surface") {
  Random random(2);
  double worst = 0;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < scaled(50'000); ++i) {
    const Vec3f base(random.in_box(-1, 1)), apex(random.in_box(-1, 1));
    const auto r0 = static_cast<float>(random.unit() * 0.5), r1 = static_cast<float>(random.unit() * 0.5);
    const Ray ray = ray_from(Vec3f(random.direction() * 3.0), Vec3f(random.direction()));
    const float t = cone({base.x, base.y, base.z, r0, apex.x, apex.y, apex.z, r1}, ray);
    if (misses(t)) {
      continue;
    }
    ++hits;
    const Vec3d axis = Vec3d(apex) - Vec3d(base), from_base = Vec3d(ray.origin) + Vec3d(ray.direction) * double{t} - Vec3d(base);
    const double height = dot(from_base, axis) / dot(axis, axis);
    const double radius = double{r0} + (double{r1} - double{r0}) * height;
    worst = std::max(worst, std::fabs(length(from_base - axis * height) - radius));
    CHECK(height > -1e-5);
    CHECK(height < 1 + 1e-5);
  }
  CHECK(hits > 0);
  CHECK(worst < 1e-5);
}

TEST_CASE("what rounding left of a ray and of a sphere counts") {
  const Vec3d center{0.1, 0.2, 0.3};
  const double radius = 1.0 / 3;
  PrimitiveValues ball{.kind = PrimitiveKind::sphere};
  std::uint32_t rests = 0;
  for (std::uint32_t row = 0; row < 4; ++row) {
    const double value = row < 3 ? center[row] : radius;
    ball.value[row] = static_cast<float>(value);
    rests |= std::uint32_t{static_cast<std::uint8_t>(rest_of(value, ball.value[row]))} << (8 * row);
  }
  ball.value[4] = std::bit_cast<float>(rests);
  Ray ray;
  ray.start_at(center + Vec3d{0.7, 1.1, 1.9});
  ray.go_along(normalize(Vec3d{-0.7, -1.1, -1.9}));
  const double distance = sphere_distance(ray, ball.value.data(), 1, 0);
  CHECK(std::fabs(distance - (length(Vec3d{0.7, 1.1, 1.9}) - radius)) < 0x1p-31);
  CHECK(intersect_sphere(ray, ball.value.data(), 1, 0) == static_cast<float>(distance));
}

}  // namespace primitive_test
