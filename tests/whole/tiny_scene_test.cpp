// A scene however tiny is the one that it is a power of two of, to the last bit of its film.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/picture/render.h"
#include "tests/support/film_of.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::tiny_scene_test {

namespace {

core::Scene scaled_by(core::Scene scene, double scale) {
  const auto move = [scale](core::Vec3d& point) { point = point * scale; };
  std::for_each(scene.vertices.begin(), scene.vertices.end(), move);
  for (core::Sphere& sphere : scene.spheres) {
    move(sphere.center);
    sphere.radius *= scale;
  }
  for (core::Cone& cone : scene.cones) {
    move(cone.base), move(cone.apex);
    cone.base_radius *= scale, cone.apex_radius *= scale;
  }
  for (core::PointLight& light : scene.lights) {
    move(light.position);
  }
  move(scene.view.from), move(scene.view.at);
  return scene;
}

std::uint64_t film_of(const core::Scene& scene) {
  const core::Database database = core::build_database(scene, {});
  const core::RenderSettings settings{database.header(), core::Camera(scene.view, database.header().frame, 24, 24, 1), {}};
  core::Operations operations;
  const std::uint64_t hash = tests::film_of(database, settings, operations).hash();
  CHECK(operations.primary_hits > 100);
  return hash;
}

}  // namespace

TEST_CASE("a scene of 10^-85, 10^-150 or 10^-270 has the film of one that is 1 across") {
  const std::uint64_t film = film_of(mirrors_and_glass());
  for (const int exponent : {-282, -498, -897}) {
    CAPTURE(exponent);
    CHECK(film_of(scaled_by(mirrors_and_glass(), std::ldexp(1.0, exponent))) == film);
  }
}

}  // namespace dmpc::tests::tiny_scene_test
