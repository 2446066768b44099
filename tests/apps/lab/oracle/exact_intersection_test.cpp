#include "apps/lab/oracle/exact_intersection.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/trace/primitive.h"
#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::exact_intersection_test {
namespace {

using apps::ExactIntersection;
using apps::Renderer;

const core::PrimitiveValues corner = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

std::vector<ExactIntersection> met(const core::Ray& from, const core::PrimitiveValues& values) {
  std::vector<ExactIntersection> exact_intersections;
  apps::add_exact_intersections(from, values, 7, exact_intersections);
  return exact_intersections;
}

TEST_CASE("a ray well inside a triangle is a certain hit for both renderers") {
  const auto exact_intersections = met(ray({0.25F, 0.25F, -2}, {0, 0, 1}), corner);
  REQUIRE(exact_intersections.size() == 1);
  CHECK((exact_intersections[0].certain(Renderer::grid) && exact_intersections[0].certain(Renderer::embree) &&
         exact_intersections[0].exact));
  CHECK(exact_intersections[0].t == 2);
  CHECK(exact_intersections[0].primitive == 7);
}

TEST_CASE("a ray well outside a triangle or behind it is no exact intersection") {
  CHECK(met(ray({0.6F, 0.6F, -2}, {0, 0, 1}), corner).empty());
  CHECK(met(ray({0.25F, 0.25F, 2}, {0, 0, 1}), corner).empty());
}

TEST_CASE("a ray on a triangle's edge is in doubt and exactly a hit") {
  const auto exact_intersections = met(ray({0.25F, 0, -2}, {0, 0, 1}), corner);
  REQUIRE(exact_intersections.size() == 1);
  CHECK(exact_intersections[0].exact);
  CHECK_FALSE(exact_intersections[0].certain(Renderer::grid));
  CHECK(exact_intersections[0].margin[0] == 0);
}

TEST_CASE("a ray one rounding outside an edge is in doubt and exactly a miss") {
  const auto exact_intersections = met(ray({0.25F, -0x1p-24F, -2}, {0, 0, 1}), corner);
  REQUIRE(exact_intersections.size() == 1);
  CHECK_FALSE(exact_intersections[0].exact);
  CHECK(exact_intersections[0].possible(Renderer::grid));
}

TEST_CASE("a ray a thousand roundings outside an edge is in no doubt") {
  CHECK(met(ray({0.25F, -0x1p-14F, -2}, {0, 0, 1}), corner).empty());
}

TEST_CASE("an edge-on triangle is never exactly a hit") {
  for (const ExactIntersection& exact_intersection : met(ray({0.25F, -2, 0}, {0, 1, 0}), corner)) {
    CHECK_FALSE(exact_intersection.exact);
    CHECK_FALSE(exact_intersection.certain(Renderer::grid));
  }
}

TEST_CASE("a ray that all but lies in a triangle's plane meets it between its vertices") {
  for (const ExactIntersection& exact_intersection : met(ray({0.25F, -2, 0x1p-26F}, {0, 1, 0x1p-27F}), corner)) {
    CHECK(exact_intersection.t >= 2);
    CHECK(exact_intersection.t <= 3);
  }
  CHECK(met(ray({0.25F, -2, 0x1p-26F}, {0, 1, 0x1p-27F}), corner).size() == 1);
}

TEST_CASE("a hit within rounding of the ray's end is in doubt") {
  const auto exact_intersections = met(shadow_ray({0.25F, 0.25F, -2}, {0, 0, 1}, std::nextafter(2.0F, 3.0F)), corner);
  REQUIRE(exact_intersections.size() == 1);
  CHECK((exact_intersections[0].at_end && exact_intersections[0].exact && !exact_intersections[0].certain(Renderer::grid)));
  CHECK(met(shadow_ray({0.25F, 0.25F, -2}, {0, 0, 1}, 1.9F), corner).empty());
}

TEST_CASE("a ray through a sphere exact intersections it twice, from inside once") {
  CHECK(met(ray({0, 0, -3}, {0, 0, 1}), sphere({0, 0, 0}, 1)).size() == 2);
  CHECK(met(ray({0, 0, 0}, {0, 0, 1}), sphere({0, 0, 0}, 1)).size() == 1);
}

TEST_CASE("a distance below all normal floats may be off by half of the least float") {
  const auto exact_intersections = met(ray({0, 0, 0}, {1, 0, 0}), cone({0, 0, 0}, 5e-41F, {0, 1, 0}, 5e-41F));
  REQUIRE(exact_intersections.size() == 1);
  CHECK(exact_intersections[0].t == doctest::Approx(5e-41));
  CHECK(exact_intersections[0].t_error > 0x1p-150);
  CHECK(exact_intersections[0].t_error < 0x1p-149);
}

TEST_CASE("a tangent ray is in doubt, a ray one float farther out misses in double as well") {
  const auto exact_intersections = met(ray({1, 0, -3}, {0, 0, 1}), sphere({0, 0, 0}, 1));
  REQUIRE_FALSE(exact_intersections.empty());
  CHECK_FALSE(exact_intersections[0].certain(Renderer::grid));
  CHECK(met(ray({std::nextafter(1.0F, 2.0F), 0, -3}, {0, 0, 1}), sphere({0, 0, 0}, 1)).empty());
}

TEST_CASE("a ray over the rim of a cylinder is in doubt") {
  const auto exact_intersections = met(ray({0, 2, -3}, {0, 0, 1}), cone({0, 0, 0}, 1, {0, 2, 0}, 1));
  REQUIRE(exact_intersections.size() == 2);
  CHECK_FALSE(exact_intersections[0].certain(Renderer::grid));
  CHECK(exact_intersections[0].exact);
}

TEST_CASE("the outside of a body with negative radius is no exact intersection") {
  const auto exact_intersections = met(ray({0, 0, -3}, {0, 0, 1}), sphere({0, 0, 0}, -1));
  REQUIRE(exact_intersections.size() == 1);
  CHECK(exact_intersections[0].t == 4);
}

TEST_CASE("examine names the margin of a miss as well") {
  CHECK(apps::examine(ray({0.6F, 0.6F, -2}, {0, 0, 1}), corner, 0).margin[0] < -1000);
  CHECK(std::isinf(apps::examine(ray({2, 0, -3}, {0, 0, 1}), sphere({0, 0, 0}, 1), 0).margin[0]));
}

/// Random rays at random places of a random triangle, at its edges and its vertices; seed fixed.
struct RandomTriangles {
  std::mt19937 engine{20260};
  float uniform(float low, float high) { return low + (high - low) * static_cast<float>(engine() >> 8U) * 0x1p-24F; }
  Vec3f point() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
};

TEST_CASE("our own kernel never errs beyond its bound on random rays at edges, vertices and needles") {
  RandomTriangles random;
  int doubtful = 0, wrong = 0;
  for (int round = 0; round < 200000; ++round) {
    const Vec3f a = random.point(), b = random.point();
    const float width = round % 3 == 0 ? 1e-5F : 1.0F;
    const Vec3f c = a + (random.point() - a) * width;
    const float u = round % 2 == 0 ? 0.0F : random.uniform(-0.2F, 1.2F), v = random.uniform(-0.2F, 1.2F);
    const Vec3f target = a + (b - a) * v + (c - a) * u;
    const Vec3f origin = random.point();
    core::Ray from = ray(origin, normalize(target - origin));
    const auto values = triangle(a, b, c);
    const float t = core::intersect_triangle(core::ShearedRay(from), values.value.data(), 1, 0);
    const ExactIntersection exact_intersection = apps::examine(from, values, 0);
    if (exact_intersection.at_end) {
      continue;
    }
    const bool hit = t > 0;
    const bool inside = exact_intersection.margin[0] >= 1 && exact_intersection.t > 0;
    const bool outside = exact_intersection.margin[0] <= -1 || exact_intersection.t <= 0;
    wrong += (inside && !hit) || (outside && hit) ? 1 : 0;
    wrong += inside && hit && std::fabs(static_cast<double>(t) - exact_intersection.t) > exact_intersection.t_error ? 1 : 0;
    doubtful += !inside && !outside ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(doubtful > 1000);
  CHECK(doubtful < 150000);
}

}  // namespace
}  // namespace dmpc::tests::exact_intersection_test
