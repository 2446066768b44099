#include "core/families/tessellation.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/expect.h"

namespace tessellation_test {

using namespace dmpc::core;

namespace {

Scene tessellated_sphere(int tessellation, const Vec3d& center, double radius) {
  Scene scene;
  SceneBuilder builder(scene);
  scenes::TessellatingSink(tessellation, builder).sphere(center, radius);
  return scene;
}

Scene tessellated_cone(int tessellation, const Cone& cone) {
  Scene scene;
  SceneBuilder builder(scene);
  scenes::TessellatingSink(tessellation, builder).cone(cone.base, cone.base_radius, cone.apex, cone.apex_radius);
  return scene;
}

/// How many triangles have a vertex normal that points against their winding.
int against_winding(const Scene& scene) {
  int count = 0;
  for (const Object& object : scene.objects) {
    const Vec3d* v = &scene.vertices[object.first];
    const Vec3d face = cross(v[1] - v[0], v[2] - v[1]);
    for (std::uint32_t i = 0; i < 3; ++i) {
      count += dot(face, scene.normals[object.first_normal + i]) > 0 ? 0 : 1;
    }
  }
  return count;
}

double area(const Scene& scene) {
  double sum = 0;
  for (const Object& object : scene.objects) {
    const Vec3d* v = &scene.vertices[object.first];
    sum += length(cross(v[1] - v[0], v[2] - v[0])) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("a sphere becomes 12 N squared triangles on it, wound outwards, with its own normals") {
  for (const int n : {1, 2, 3, 7}) {
    const Scene scene = tessellated_sphere(n, {1, 2, 3}, 0.5);
    CHECK(scene.objects.size() == static_cast<std::size_t>(12 * n * n));
    CHECK(against_winding(scene) == 0);
    for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
      CHECK(length(scene.vertices[i] - (Vec3d{1, 2, 3} + 0.5 * scene.normals[i])) < 1e-15);
      CHECK(length(scene.normals[i]) == doctest::Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("a sphere with N = 1 is the cube inscribed in it") {
  const Scene scene = tessellated_sphere(1, {}, std::sqrt(3.0));
  CHECK(area(scene) == doctest::Approx(24));
}

TEST_CASE("a finer sphere comes closer to its area") {
  CHECK(area(tessellated_sphere(16, {}, 1)) == doctest::Approx(12.566).epsilon(0.003));
}

TEST_CASE("a cylinder becomes 8 N triangles, wound outwards, with radial normals") {
  const Cone cylinder = {{0, 0, -1}, 2, {0, 0, 3}, 2};
  const Scene scene = tessellated_cone(3, cylinder);
  CHECK(scene.objects.size() == 24);
  CHECK(against_winding(scene) == 0);
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    CHECK(scene.normals[i].z == doctest::Approx(0));
    CHECK(length(Vec3d{scene.vertices[i].x, scene.vertices[i].y, 0} - 2.0 * scene.normals[i]) < 1e-14);
  }
}

TEST_CASE("a cylinder with N = 1 is a square tube") {
  CHECK(area(tessellated_cone(1, {{1, 0, 0}, 1, {1, 0, 5}, 1})) == doctest::Approx(4 * std::sqrt(2.0) * 5));
}

TEST_CASE("a cone's normals stand across its side, pointing outwards") {
  const Scene scene = tessellated_cone(2, {{0, 0, 0}, 1, {3, 4, 0}, 0.5});
  CHECK(against_winding(scene) == 0);
  const Vec3d tip = {6, 8, 0};
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    CHECK(std::abs(dot(scene.normals[i], scene.vertices[i] - tip)) < 1e-14);
    CHECK(length(scene.normals[i]) == doctest::Approx(1));
  }
}

TEST_CASE("a curve divided into nothing breaks an invariant") {
  Scene scene;
  SceneBuilder builder(scene);
  CHECK_THROWS_AS(scenes::TessellatingSink(0, builder), InternalError);
}

}  // namespace tessellation_test
