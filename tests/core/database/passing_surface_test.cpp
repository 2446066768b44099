#include <doctest/doctest.h>

#include <cmath>

#include "core/database/database.h"
#include "core/scene/frame.h"
#include "tests/support/large_bodies.h"

namespace passing_surface_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// How far the surface of a body is from a point, outside of it.
double gap_of(const Sphere& sphere, const Vec3d& point) { return length(point - sphere.center) - sphere.radius; }
double gap_of(const Cone& cone, const Vec3d& point) {
  const Vec3d axis = cone.apex - cone.base, from_base = point - cone.base;
  const double height = dot(from_base, axis) / dot(axis, axis);
  return length(from_base - axis * height) - (cone.base_radius + (cone.apex_radius - cone.base_radius) * height);
}

}  // namespace

TEST_CASE("a large body passes by the detail of its scene where the file says, whatever its radius") {
  for (const LargeBody body : {LargeBody::planet, LargeBody::pipe, LargeBody::mountain}) {
    for (const double radius : {1e4, 1e6, 1e8}) {
      CAPTURE(static_cast<int>(body));
      CAPTURE(radius);
      const Scene scene = beside_large(body, radius);
      const Database database = build_database(scene, {});
      const GridFrame& frame = database.header().frame;
      const PrimitiveValues& large = database.primitives().back();
      const CurvedValues values = large.curved();
      for (const Vec3d& point : {Vec3d{0, 0, 0}, Vec3d{5, 3, -1}, Vec3d{-4, 5, 2}}) {
        const double expected =
            body == LargeBody::planet ? gap_of(scene.spheres.back(), point) : gap_of(scene.cones.back(), point);
        const Vec3d local = to_local(frame, point);
        const double found = body == LargeBody::planet
                                 ? gap_of(Sphere{.center = values.vector(0), .radius = values.value(3)}, local)
                                 : gap_of(Cone{.base = values.vector(0),
                                               .base_radius = values.value(3),
                                               .apex = values.apex(),
                                               .apex_radius = values.value(7)},
                                          local);
        CHECK(std::fabs(found / frame.scale - expected) < 1e-5);
      }
    }
  }
}

TEST_CASE("what does not pass by local zero has its rests as ever") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({});
  builder.sphere({0.3, 0.4, 0.5}, 1);
  builder.cone({1.1, 2.3, 0.7}, 0.8, {3.7, 0.3, 1.9}, 0.5);
  const Database database = build_database(scene, {});
  for (const PrimitiveValues& primitive : database.primitives()) {
    CHECK_FALSE(primitive.curved().passes_by());
  }
}

}  // namespace passing_surface_test
