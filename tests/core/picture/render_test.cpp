#include "core/picture/render.h"

#include <doctest/doctest.h>

#include "tests/support/film_of.h"
#include "tests/support/shooting.h"

namespace render_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

struct Picture {
  Film film;
  Operations operations;
};

Picture rendered(const Scene& scene, int side, int samples, const ShadeOptions& shade = {}) {
  const Database database = database_of(scene);
  Operations operations;
  Film film =
      film_of(database, {database.header(), Camera(scene.view, database.header().frame, side, side, samples), shade}, operations);
  return {std::move(film), operations};
}

}  // namespace

TEST_CASE("a picture of nothing is the background, exactly") {
  Scene scene;
  SceneBuilder(scene).background({0.25, 0.5, 1});
  const Picture picture = rendered(scene, 5, 3);
  for (std::uint32_t pixel = 0; pixel < 25; ++pixel) {
    CHECK(picture.film.radiance(pixel) == Vec3d{0.25, 0.5, 1});
  }
}

TEST_CASE("a sphere lit and seen from its centre is Kd everywhere") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({.position = {0, 0, 0}, .color = {1, 1, 1}, .has_color = true});
  builder.material({.color = {1, 0.5, 0.25}, .diffuse = 0.5});
  builder.sphere({0, 0, 0}, 2);
  scene.view = {.from = {0, 0, 0}, .at = {1, 2, 3}, .up = {0, 1, 0}, .angle_degrees = 100};
  const Picture picture = rendered(scene, 16, 1);
  for (std::uint32_t pixel = 0; pixel < 256; ++pixel) {
    CHECK(picture.film.radiance(pixel).x == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(picture.film.radiance(pixel).z == doctest::Approx(0.125).epsilon(1e-5));
  }
  CHECK(picture.operations.shadow_blocked == 0);
}

TEST_CASE("an ambient light shows the diffuse colour of what no light falls on, through mirrors, too, and nothing else") {
  Scene scene;
  scene.ambient = {0.5, 1, 2};
  SceneBuilder builder(scene);
  builder.material({.color = {1, 0.5, 0.25}, .diffuse = 0.5, .specular = 0.25});
  builder.sphere({0, 0, 0}, 2);
  scene.view = {.from = {0, 0, 0}, .at = {1, 2, 3}, .up = {0, 1, 0}, .angle_degrees = 100};
  const Picture once = rendered(scene, 4, 1, {.depth_max = 1}), twice = rendered(scene, 4, 1, {.depth_max = 2});
  for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
    CHECK(once.film.radiance(pixel) == Vec3d{0.25, 0.25, 0.25});
    CHECK(twice.film.radiance(pixel) == Vec3d{0.3125, 0.3125, 0.3125});
  }
  CHECK(once.operations.ray_count() == 16);
}

TEST_CASE("a glass ball in a white room takes from a ray what the depth limit cuts") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material({.diffuse = 0, .specular = 0.4, .transmittance = 0.6, .refraction_index = 1});
  builder.sphere({0, 0, 0}, 1);
  scene.view = {.from = {0, 0, 4}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 10};
  double cut = 0.6;  // carried by the rays still in the ball: 0.4 of it stays there at every further depth
  for (int depth = 2; depth <= 8; ++depth) {
    CHECK(rendered(scene, 3, 1, {.depth_max = depth}).film.radiance(4).x == doctest::Approx(1 - cut).epsilon(1e-5));
    cut *= 0.4;
  }
}

TEST_CASE("two facing mirrors multiply their weights") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material({.diffuse = 0, .specular = 0.5});
  builder.polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}});
  builder.polygon({{-0.5, -9, 2}, {-0.5, 9, 2}, {-3, 9, 2}, {-3, -9, 2}});
  // Down at 45 degrees, up, under the second mirror, down, up and out.
  scene.view = {.from = {1.5, 0, 1}, .at = {0.5, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1};
  CHECK(rendered(scene, 1, 1).film.radiance(0).x == doctest::Approx(0.125).epsilon(1e-6));
}

TEST_CASE("one triangle covers the pixels that its projection covers") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.background({1, 1, 1});
  builder.material({.diffuse = 0});
  builder.polygon({{-2, -2, 0}, {2.001, -2, 0}, {-2, 2.001, 0}});
  // At distance 1 / tan(22.5): the outermost pixel centres lie at -1 and 1.
  scene.view = {.from = {0, 0, 2.414213562373095}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 45};
  const Picture picture = rendered(scene, 9, 1);
  CHECK(picture.operations.primary_hits == 45);
  CHECK(picture.film.radiance(0).x == 0);
  CHECK(picture.film.radiance(8).x == 1);
  CHECK(picture.film.radiance(72).x == 0);
}

TEST_CASE("an object between floor and light throws a shadow") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({.position = {0, 0, 4}});
  builder.material({});
  builder.polygon({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  builder.sphere({0, 0, 2}, 0.2);
  scene.view = {.from = {0, -3, 0.5}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 30};
  const Picture picture = rendered(scene, 3, 1);
  CHECK(picture.film.radiance(4) == Vec3d{});
  CHECK(picture.film.radiance(7).x > 0);
  CHECK(picture.operations.shadow_blocked > 0);
}

TEST_CASE("rendering twice gives the same hash, another view another") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({.position = {3, 3, 3}});
  builder.sphere({0, 0, 0}, 1);
  scene.view.from = {0, 0, 4};
  const std::uint64_t hash = rendered(scene, 8, 2).film.hash();
  CHECK(rendered(scene, 8, 2).film.hash() == hash);
  scene.view.from = {0, 0, 5};
  CHECK(rendered(scene, 8, 2).film.hash() != hash);
}

}  // namespace render_test
