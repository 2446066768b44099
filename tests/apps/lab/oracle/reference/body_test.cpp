#include "apps/lab/oracle/reference/body.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace dmpc::tests::body_test {
namespace {

using apps::ReferenceBody;
using apps::ReferenceRay;
using core::PrimitiveKind;
using core::Vec3d;
using doctest::Approx;

ReferenceRay shot(const Vec3d& origin, const Vec3d& towards) { return {.origin = origin, .direction = normalize(towards)}; }

ReferenceBody triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return {.kind = PrimitiveKind::triangle, .place = {a, b, c}};
}
ReferenceBody sphere(const Vec3d& center, double radius) {
  return {.kind = PrimitiveKind::sphere, .place = {center}, .radius = {radius}};
}
ReferenceBody cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) {
  return {.kind = PrimitiveKind::cone, .place = {base, apex}, .radius = {base_radius, apex_radius}};
}
/// The distance, or minus 1 for a miss.
double distance(const ReferenceBody& body, const ReferenceRay& ray) { return distance_to(body, ray).value_or(-1); }

const ReferenceBody floor_triangle = triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});

TEST_CASE("a triangle is hit inside and missed beside, behind and in its own plane") {
  CHECK(distance(floor_triangle, shot({0.5, 0.5, 3}, {0, 0, -1})) == 3);
  CHECK(distance(floor_triangle, shot({0.5, 0.5, -3}, {0, 0, 1})) == 3);
  CHECK(distance(floor_triangle, shot({1.5, 1.5, 3}, {0, 0, -1})) == -1);
  CHECK(distance(floor_triangle, shot({0.5, 0.5, 3}, {0, 0, 1})) == -1);
  CHECK(distance(floor_triangle, shot({-1, 0.5, 0}, {1, 0, 0})) == -1);
}

TEST_CASE("an edge and a corner belong to their triangle") {
  CHECK(distance(floor_triangle, shot({1, 0, 1}, {0, 0, -1})) == 1);
  CHECK(distance(floor_triangle, shot({1, 1, 1}, {0, 0, -1})) == 1);
  CHECK(distance(floor_triangle, shot({2, 0, 1}, {0, 0, -1})) == 1);
}

TEST_CASE("a hit counts before the end of its ray and not at it") {
  ReferenceRay ray = shot({0.5, 0.5, 3}, {0, 0, -1});
  ray.t_max = 3;
  CHECK(distance(floor_triangle, ray) == -1);
  ray.t_max = std::nextafter(3.0, 4.0);
  CHECK(distance(floor_triangle, ray) == 3);
}

TEST_CASE("a triangle's surface has the point, the winding's normal and the weights of its corners") {
  const ReferenceRay ray = shot({0.5, 0.25, 3}, {0, 0, -1});
  const apps::ReferenceSurface surface = surface_at(floor_triangle, ray, 3);
  CHECK(length(surface.point - Vec3d{0.5, 0.25, 0}) < 1e-15);
  CHECK(surface.normal == Vec3d{0, 0, 1});
  CHECK(surface.weight[0] == Approx(0.625));
  CHECK(surface.weight[1] == Approx(0.25));
  CHECK(surface.weight[2] == Approx(0.125));
}

TEST_CASE("a sphere is hit in front, from inside and not from behind") {
  CHECK(distance(sphere({0, 0, 0}, 1), shot({0, 0, 5}, {0, 0, -1})) == 4);
  CHECK(distance(sphere({0, 0, 0}, 1), shot({0, 0, 0.5}, {0, 0, -1})) == 1.5);
  CHECK(distance(sphere({0, 0, 0}, 1), shot({0, 0, 5}, {0, 0, 1})) == -1);
  CHECK(distance(sphere({0, 0, 0}, 1), shot({0, 1.001, 5}, {0, 0, -1})) == -1);
}

TEST_CASE("a negative radius shows the inside only") {
  CHECK(distance(sphere({0, 0, 0}, -1), shot({0, 0, 5}, {0, 0, -1})) == 6);
  CHECK(distance(cone({0, 0, -1}, -1, {0, 0, 1}, -1), shot({5, 0, 0}, {-1, 0, 0})) == Approx(6).epsilon(1e-15));
  CHECK(distance(cone({0, 0, -1}, 1, {0, 0, 1}, 1), shot({5, 0, 0}, {-1, 0, 0})) == Approx(4).epsilon(1e-15));
}

TEST_CASE("a tiny sphere far away is hit as exactly as a near one") {
  const double offset = 3e-4, radius = 1e-3;
  const double expected = 1e6 - std::sqrt(radius * radius - offset * offset);
  CHECK(std::fabs(distance(sphere({offset, 0, 0}, radius), shot({0, 0, 1e6}, {0, 0, -1})) - expected) < 3e-10);
}

TEST_CASE("a point of a sphere lies on it, whatever its distance") {
  const ReferenceBody body = sphere({1, 2, 3}, 0.5);
  const ReferenceRay ray = shot({1000, 900, 800}, Vec3d{1.2, 2.1, 3.1} - Vec3d{1000, 900, 800});
  const apps::ReferenceSurface surface = surface_at(body, ray, distance(body, ray));
  CHECK(std::fabs(length(surface.point - body.place[0]) - 0.5) < 1e-15);
  CHECK(dot(ray.direction, surface.normal) < 0);
}

TEST_CASE("a cylinder is open at its ends") {
  const ReferenceBody tube = cone({0, 0, 0}, 1, {0, 0, 2}, 1);
  CHECK(distance(tube, shot({0.5, 0, 5}, {0, 0, -1})) == -1);
  CHECK(distance(tube, shot({5, 0, 1}, {-1, 0, 0})) == 4);
  CHECK(distance(tube, shot({5, 0, 2.001}, {-1, 0, 0})) == -1);
}

TEST_CASE("a cone is hit where its radius says and has a sloping normal") {
  const ReferenceBody body = cone({0, 0, 0}, 2, {0, 0, 2}, 0);
  const ReferenceRay ray = shot({5, 0, 1}, {-1, 0, 0});
  CHECK(distance(body, ray) == Approx(4).epsilon(1e-15));
  const apps::ReferenceSurface surface = surface_at(body, ray, distance(body, ray));
  CHECK(length(surface.point - Vec3d{1, 0, 1}) < 1e-14);
  CHECK(length(surface.normal - Vec3d{std::sqrt(0.5), 0, std::sqrt(0.5)}) < 1e-14);
}

TEST_CASE("a ray along a cone's own slope meets its other side once") {
  const ReferenceBody body = cone({0, 0, 0}, 2, {0, 0, 2}, 0);
  CHECK(distance(body, shot({-3, 0, 0}, {1, 0, 1})) == -1);
  CHECK(distance(body, shot({0, 0, 0}, {1, 0, 1})) == Approx(std::sqrt(2.0)));
}

TEST_CASE("what has no area, no radius, no length or no finite place is not usable") {
  CHECK(is_usable(floor_triangle));
  CHECK_FALSE(is_usable(triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2})));
  CHECK_FALSE(is_usable(triangle({0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0})));
  CHECK_FALSE(is_usable(sphere({0, 0, 0}, 0)));
  CHECK_FALSE(is_usable(sphere({0, 0, 1e31}, 1)));
  CHECK_FALSE(is_usable(cone({0, 0, 0}, 1, {0, 0, 0}, 1)));
  CHECK_FALSE(is_usable(cone({0, 0, 0}, 0, {0, 0, 1}, 0)));
  CHECK(is_usable(cone({0, 0, 0}, 0, {0, 0, 1}, 1)));
}

TEST_CASE("bounds enclose the body") {
  const core::Box box = bounds_of(cone({0, 0, 0}, 1, {4, 0, 0}, -2));
  CHECK(box.low == Vec3d{-1, -2, -2});
  CHECK(box.high == Vec3d{6, 2, 2});
}

}  // namespace
}  // namespace dmpc::tests::body_test
