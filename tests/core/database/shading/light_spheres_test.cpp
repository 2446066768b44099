#include "core/database/shading/light_spheres.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/support/small_scenes.h"

namespace light_spheres_test {

using namespace dmpc::core;

namespace {

/// A ball about the origin and lights.
Scene lit(const std::vector<PointLight>& lights) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  scene.lights = lights;
  scene.view = {.from = {0, -5, 0}, .at = {0, 0, 0}, .up = {0, 0, 1}};
  return scene;
}

}  // namespace

TEST_CASE("a point light becomes a black ball that shines with the square of its way to the middle over its radius") {
  Scene scene = lit({{{0, 0, 4}, {1, 0.5, 0.25}, true}});
  CHECK(make_lights_spheres(scene, 0.5) == 0);
  CHECK(scene.lights.empty());
  REQUIRE(scene.spheres.size() == 2);
  CHECK(scene.spheres[1].center == Vec3d{0, 0, 4});
  CHECK(scene.spheres[1].radius == 0.5);
  const Material& material = scene.materials[scene.objects[1].material];
  CHECK(material.diffuse == 0);
  CHECK(material.emission == Vec3d{64, 32, 16});
}

TEST_CASE("lights without a colour are as bright together as they were") {
  Scene scene = lit({{.position = {0, 0, 4}}, {.position = {0, 0, -4}}});
  make_lights_spheres(scene, 1);
  CHECK(scene.materials[scene.objects[1].material].emission.x == doctest::Approx(16 / std::sqrt(2.0)));
}

TEST_CASE("a light in the eye stays a point, and one in the middle shines with its intensity") {
  Scene scene = lit({{{0, -5, 0.1}, {1, 1, 1}, true}, {{0, 0, 0}, {2, 2, 2}, true}});
  CHECK(make_lights_spheres(scene, 0.5) == 1);
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].position.y == -5);
  CHECK(scene.materials[scene.objects[1].material].emission.x == 2);
}

TEST_CASE("a light as far away as those are that stand for a direction stays a point") {
  Scene scene = lit({{{0, 0, 1e3}, {1, 1, 1}, true}, {{0, 0, 300}, {1, 1, 1}, true}});
  CHECK(make_lights_spheres(scene, 0.5) == 1);
  CHECK(scene.lights.at(0).position.z == 1e3);
}

TEST_CASE("lights of a radius that is nothing beside the scene stay points, and shine as before") {
  for (const double radius : {1e-7, 1e-12, 1e-40}) {
    Scene scene = lit({{{0, 0, 4}, {1, 0.5, 0.25}, true}});
    CHECK(make_lights_spheres(scene, radius) == 1);
    CHECK(scene.lights.at(0).position == Vec3d{0, 0, 4});
    CHECK(scene.spheres.size() == 1);
  }
}

TEST_CASE("a light that falls off lights as it did as a sphere, and one in a cone stays a point") {
  PointLight falling{{0, 0, 4}, {2, 2, 2}, true}, spot{{0, 0, 4}, {2, 2, 2}, true};
  falling.falls_off_from = 0.01;
  spot.cone = {.ahead = {0, 0, -1}, .full_degrees = 5, .none_degrees = 10};
  Scene scene = lit({falling, spot});
  CHECK(make_lights_spheres(scene, 0.5) == 1);
  CHECK(scene.lights.at(0).cone.none_degrees == 10);
  CHECK(scene.materials[scene.objects[1].material].emission.x == 8);  // pi L r^2 is the intensity, pi times the colour
}

TEST_CASE("without objects lights stay points") {
  Scene scene;
  scene.lights = {{.position = {1, 2, 3}}};
  CHECK(make_lights_spheres(scene, 0.5) == 1);
  CHECK(scene.objects.empty());
}

}  // namespace light_spheres_test
