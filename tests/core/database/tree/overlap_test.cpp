#include "core/database/tree/overlap.h"

#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/random.h"
#include "tests/support/scaled.h"

namespace overlap_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

PrimitiveValues values(PrimitiveKind kind, std::array<float, value_count_max> row) { return {kind, row}; }

PrimitiveValues random_primitive(PrimitiveKind kind, Random& random) {
  PrimitiveValues primitive{.kind = kind};
  for (std::size_t row = 0; row < value_count(kind); ++row) {
    primitive.value[row] = static_cast<float>(random.unit());
  }
  return primitive;
}

/// A point of the surface.
Vec3d sample(const PrimitiveValues& p, Random& random) {
  const Vec3d a = p.vector(0);
  if (p.kind == PrimitiveKind::sphere) {
    return a + random.direction() * double{p.value[3]};
  }
  if (p.kind == PrimitiveKind::triangle) {
    const double u = random.unit(), v = random.unit() * (1 - u);
    return a + (p.vector(3) - a) * u + (p.vector(6) - a) * v;
  }
  const Vec3d axis = p.vector(4) - a, radial = normalize(cross(axis, random.direction()));
  const double height = random.unit();
  return a + axis * height + radial * (double{p.value[3]} + (double{p.value[7]} - double{p.value[3]}) * height);
}

}  // namespace

TEST_CASE("a box around any point of a surface touches the primitive") {
  Random random(1);
  std::size_t missed_boxes = 0;
  for (std::size_t i = 0; i < scaled(3000); ++i) {
    const auto kind = static_cast<PrimitiveKind>(i % 3);
    const PrimitiveValues primitive = random_primitive(kind, random);
    const Overlap overlap(primitive);
    for (int j = 0; j < 20; ++j) {
      const Vec3d at = sample(primitive, random), half = random.in_box(1e-9, 0.1);
      const Vec3d shift{half.x * random.between(-0.99, 0.99), half.y * random.between(-0.99, 0.99),
                        half.z * random.between(-0.99, 0.99)};
      missed_boxes += overlap.touches(at + shift, half) ? 0 : 1;
    }
  }
  CHECK(missed_boxes == 0);
}

TEST_CASE("a box off a triangle's plane or beside its edges does not touch it") {
  const Overlap overlap(values(PrimitiveKind::triangle, {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const Vec3d half{0.1, 0.1, 0.1};
  CHECK(overlap.touches({0.2, 0.2, 0.05}, half));
  CHECK_FALSE(overlap.touches({0.2, 0.2, 0.2}, half));
  CHECK_FALSE(overlap.touches({0.8, 0.8, 0}, half));
  CHECK_FALSE(overlap.touches({-0.2, 0.5, 0}, half));
}

TEST_CASE("a box that only shares a face, an edge or a corner touches") {
  const Overlap overlap(values(PrimitiveKind::triangle, {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  CHECK(overlap.touches({0.25, 0.25, 0.5}, {0.25, 0.25, 0.5}));
  CHECK(overlap.touches({-0.5, -0.5, 0.5}, {0.5, 0.5, 0.5}));
}

TEST_CASE("a box inside a sphere or outside it does not touch its surface") {
  const Overlap overlap(values(PrimitiveKind::sphere, {0, 0, 0, -1}));
  const Vec3d half{0.1, 0.1, 0.1};
  CHECK_FALSE(overlap.touches({0, 0, 0}, half));
  CHECK_FALSE(overlap.touches({0.4, 0.4, 0.4}, half));
  CHECK(overlap.touches({1, 0, 0}, half));
  CHECK_FALSE(overlap.touches({0.8, 0.8, 0.8}, half));
  CHECK(overlap.touches({0, 0, 0}, {1, 1, 1}));
}

TEST_CASE("a box that only meets a sphere's extreme point touches") {
  const Overlap overlap(values(PrimitiveKind::sphere, {0, 0, 0, 1}));
  const double next = std::nextafter(1.125, 2.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3d at;
    at[axis] = 1.125;
    CHECK(overlap.touches(at, {0.125, 0.125, 0.125}));
    at[axis] = next;
    CHECK_FALSE(overlap.touches(at, {0.125, 0.125, 0.125}));
  }
}

TEST_CASE("a box inside a cylinder does not touch it") {
  const Overlap overlap(values(PrimitiveKind::cone, {0, 0, 0, 1, 0, 0, 2, 1}));
  CHECK_FALSE(overlap.touches({0, 0, 1}, {0.1, 0.1, 0.1}));
  CHECK(overlap.touches({1, 0, 1}, {0.1, 0.1, 0.1}));
  CHECK_FALSE(overlap.touches({1, 0, 2.2}, {0.1, 0.1, 0.1}));
}

TEST_CASE("bounds are as tight as the primitive") {
  const Box triangle = bounds_of(values(PrimitiveKind::triangle, {0, 1, 2, 3, -1, 0, 1, 1, 1}));
  CHECK(triangle.low == Vec3d{0, -1, 0});
  CHECK(triangle.high == Vec3d{3, 1, 2});
  const Box sphere = bounds_of(values(PrimitiveKind::sphere, {1, 2, 3, -0.5F}));
  CHECK(sphere.low == Vec3d{0.5, 1.5, 2.5});
  CHECK(sphere.high == Vec3d{1.5, 2.5, 3.5});
  const Box upright = bounds_of(values(PrimitiveKind::cone, {0, 0, 0, 1, 0, 0, 2, 0.5F}));
  CHECK(upright.low == Vec3d{-1, -1, 0});
  CHECK(upright.high == Vec3d{1, 1, 2});
}

}  // namespace overlap_test
