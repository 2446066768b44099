#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "core/scene/frame.h"
#include "tests/support/shooting.h"

namespace eye_on_surface_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// From the eye on a body, all ways: rays that leave it must not meet it, rays into it must meet its far side.
void look_around(Scene scene, const Vec3d& normal, Random& random) {
  SceneBuilder(scene).polygon({{-4, -4, -4}, {4, -4, -4}, {4, 4, 4}});
  scene.view.up = normalize(cross(normal, random.direction()));
  for (const Vec3d& towards : {normal, -normal, cross(normal, scene.view.up)}) {
    scene.view.at = scene.view.from + towards;
    const Database database = build_database(scene, {});
    const Camera camera(scene.view, database.header().frame, 16, 16, 1);
    for (std::uint32_t pixel = 0; pixel < camera.pixel_count(); ++pixel) {
      const Ray ray = camera.primary_ray(pixel, 0);
      const double out = dot(ray.full_direction(), normal);
      const PrimitiveValues& body = database.primitives()[0];
      const float t = body.kind == PrimitiveKind::sphere ? intersect_sphere(ray, body.value.data(), 1, 0)
                                                         : intersect_cone(ray, body.value.data(), 1, 0);
      CAPTURE(out);
      if (std::fabs(out) > 1e-3) {
        REQUIRE((t > 0) == (out < 0));
        REQUIRE((out > 0 || double{t} > 1e-4 * database.header().frame.scale));
      }
    }
  }
}

}  // namespace

TEST_CASE("an eye on a ball sees what lies around it, and its inside, not the spot where it is") {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    Scene scene;
    SceneBuilder builder(scene);
    builder.material({});
    const bool is_round = i % 2 == 0;
    const Vec3d center = is_round ? Vec3d{} : random.in_box(-2, 2), normal = is_round ? Vec3d{0, 0, 1} : random.direction();
    const double radius = is_round ? 1 : random.between(0.3, 2.0);
    builder.sphere(center, radius);
    scene.view = {.from = center + normal * radius, .at = {}, .up = {}, .angle_degrees = 120};
    look_around(scene, normal, random);
  }
}

TEST_CASE("so does an eye on a pipe") {
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    Scene scene;
    SceneBuilder builder(scene);
    builder.material({});
    const bool is_round = i % 2 == 0;
    const Vec3d axis = is_round ? Vec3d{1, 0, 0} : random.direction(), base = is_round ? Vec3d{} : random.in_box(-2, 2);
    const Vec3d normal = is_round ? Vec3d{0, 0, 1} : normalize(cross(axis, random.direction()));
    const double radius = is_round ? 1 : random.between(0.3, 2.0);
    builder.cone(base - axis * 100.0, radius, base + axis * 100.0, radius);
    scene.view = {.from = base + normal * radius, .at = {}, .up = {}, .angle_degrees = 90};
    look_around(scene, normal, random);
  }
}

}  // namespace eye_on_surface_test
