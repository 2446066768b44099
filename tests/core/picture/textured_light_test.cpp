// What a texture shows against the same pattern laid in polygons, which know nothing of textures.
#include <doctest/doctest.h>

#include <cmath>

#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "tests/support/checked_floor.h"
#include "tests/support/film_of.h"

namespace textured_light_test {

using namespace dmpc;
using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

Film picture_of(const Scene& scene, int side, int samples, double error = 0) {
  const Database database = build_database(scene, {});
  const Camera camera(scene.view, database.header().frame, side, side, samples);
  const RenderSettings settings{database.header(),
                                camera,
                                {.pixel_share = database.records().textured > 0 ? 1.0 / (error > 0 ? 2 : 1) : 0,
                                 .first_samples = static_cast<std::uint32_t>(samples)},
                                {.error = error}};
  return film_of(database, settings);
}

constexpr int side = 32;

Scene seen_at(Scene scene, double angle_degrees) {
  scene.view.angle_degrees = angle_degrees;
  return scene;
}

/// How far a painted floor is from the one that is laid, seen with very many samples: root mean square, in 255ths.
double error_between(const Film& painted, const Film& laid) {
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < side * side; ++pixel) {
    const Vec3d off = painted.radiance(pixel) - laid.radiance(pixel);
    squares += dot(off, off);
  }
  return 255 * std::sqrt(squares / (3 * side * side));
}

double error_of_paint(int samples, double error = 0) {
  static const Film laid = picture_of(CheckedFloor::laid(), side, 1024);
  return error_between(picture_of(CheckedFloor::painted(), side, samples, error / 255), laid);
}

/// A wall of one colour, straight ahead, under a light at a slant: its middle.
Vec3d light_of_wall(const Vec3d& color, const Vec3d& light, std::uint32_t texel) {
  Scene scene;
  scene.view = {.from = {0, 0, 2}, .at = {0, 0, 0}, .up = {0, 1, 0}};
  scene.lights = {{light, {1, 1, 1}, true}};
  scene.textures.push_back({.levels = {{1, 1, {texel}}}});
  SceneBuilder builder(scene);
  builder.material({.color = color, .diffuse = 0.8, .texture = 0});
  builder.textured({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{{}, {0, 1}}, {{}, {1, 1}}, {{}, {1, 0}}, {{}, {0, 0}}});
  return picture_of(scene, 1, 1).radiance(0);
}

}  // namespace

TEST_CASE("a floor painted with checks becomes the floor laid in checks as samples grow") {
  // Polygons with as many samples are 10.8, 1.65 and 0.57 off.
  CHECK(error_of_paint(1) < 2.6);
  CHECK(error_of_paint(16) < 1.1);
  CHECK(error_of_paint(64) < 0.35);
}

TEST_CASE("a painted floor that is refined keeps to the error asked for") {
  for (const double error : {4.0, 1.0}) {
    CHECK(error_of_paint(2, error) < 1.05 * error);
  }
}

TEST_CASE("a painted floor that is refined keeps to the error asked for, however wide the view") {
  for (const double angle_degrees : {110.0, 125.0, 140.0}) {
    CAPTURE(angle_degrees);
    const Film laid = picture_of(seen_at(CheckedFloor::laid(), angle_degrees), side, 1024);
    const Film painted = picture_of(seen_at(CheckedFloor::painted(), angle_degrees), side, 2, 1.0 / 255);
    CHECK(error_between(painted, laid) < 1.05);
  }
}

TEST_CASE("samples lie the nearer to each other the more there are when their pass has ended") {
  CHECK(sample_spacing(0, 1) == 1);
  CHECK(sample_spacing(8, 9) == 1.0 / 3);
  for (const std::uint32_t sample : {0U, 1U}) {
    CHECK(sample_spacing(sample, 2) == doctest::Approx(std::sqrt(0.5)));
  }
  for (const std::uint32_t sample : {8U, 12U, 15U}) {
    CHECK(sample_spacing(sample, 2) == 0.25);
  }
  CHECK(sample_spacing(16, 2) == doctest::Approx(std::sqrt(1.0 / 32)));
}

TEST_CASE("a painted wall gives back its colours by the cosine of its angle to the light") {
  const Vec3d color{1, 0.5, 0.25}, light{3, 0, 4};
  const Vec3d seen = light_of_wall(color, light, 0xffffff), expected = color * (0.8 * 4 / 5);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    CHECK(seen[channel] == doctest::Approx(expected[channel]).epsilon(1e-5));
  }
}

}  // namespace textured_light_test
