#include "core/picture/surfaces/layer.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/picture/camera/layer_settings.h"
#include "tests/support/film_of.h"
#include "tests/support/mesh_surfaces.h"

namespace layer_test {

using namespace dmpc;
using namespace dmpc::core;
using tests::film_of;

namespace {

constexpr int side = 9;

/// Seen from (0, -5, 0) along y.
Scene alone(const Material& material) {
  Scene scene;
  scene.view = {.from = {0, -5, 0}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
  scene.background = {9, 9, 9};
  scene.lights = {{{0, -9, 9}}};
  SceneBuilder(scene).material(material);
  return scene;
}

Scene ball(const Material& material) {
  Scene scene = alone(material);
  SceneBuilder builder(scene);
  builder.material(material);
  builder.sphere({0, 0, 0}, 1);
  return scene;
}

Film layer_of(Layer layer, const Scene& scene, bool by_paths = false, int samples = 1) {
  const Database database = build_database(scene, {.for_paths = by_paths});
  const Transport transport{.kind = by_paths ? TransportKind::paths : TransportKind::whitted, .has_sky = by_paths};
  const RenderSettings settings{.header = database.header(),
                                .camera = Camera(scene.view, database.header().frame, side, side, samples),
                                .shade = {.depth_max = 1, .pixel_share = 1, .transport = transport}};
  return film_of(database, layer_settings(layer, settings));
}

Vec3d middle_of(const Film& film) { return film.radiance(side * side / 2); }
Vec3d corner_of(const Film& film) { return film.radiance(0); }

bool is_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-5) { return length(a - b) <= tolerance; }

/// A wall of half of alpha before one behind it.
Scene veiled(double alpha) {
  Scene scene = alone({});
  SceneBuilder builder(scene);
  builder.material({.color = {1, 1, 1}, .diffuse = 0.5, .transmittance = 0.2, .refraction_index = 1.5, .alpha = AlphaUse::blend});
  const auto veil = [alpha](const Vec3d& color) { return colored_corner({0, -1, 0}, color, alpha); };
  tests::add_colored_square(builder, {-4, -1, -4}, 8,
                            {veil({1, 0.5, 0}), veil({1, 0.5, 0}), veil({1, 0.5, 0}), veil({1, 0.5, 0})});
  builder.material({.color = {0.25, 0.5, 1}, .diffuse = 0.8});
  builder.polygon({{-9, 2, -9}, {9, 2, -9}, {9, 2, 9}, {-9, 2, 9}});
  return scene;
}

}  // namespace

TEST_CASE("albedo is what a surface scatters, mirrors and transmits, at most 1, whatever shines on it") {
  const Film matt = layer_of(Layer::albedo, ball({.color = {0.8, 0.4, 0.2}, .diffuse = 0.5}));
  CHECK(is_near(middle_of(matt), {0.4, 0.2, 0.1}));
  CHECK(corner_of(matt) == Vec3d{});
  const Film shining = layer_of(Layer::albedo, ball({.color = {0.8, 0.4, 0.2}, .diffuse = 0.5, .emission = {3, 3, 3}}), true);
  CHECK(is_near(middle_of(shining), {0.4, 0.2, 0.1}));
  const Film mirror = layer_of(
      Layer::albedo, ball({.color = {1, 0, 0}, .diffuse = 0.25, .specular = 0.5, .specular_color = {1, 0.5, 0}, .mirror = 1}));
  CHECK(is_near(middle_of(mirror), {0.75, 0.25, 0}));
  const Film glass =
      layer_of(Layer::albedo, ball({.diffuse = 0, .specular = 0.1, .transmittance = 0.9, .refraction_index = 1.5}));
  CHECK(is_near(middle_of(glass), {1, 1, 1}));
  const Film too_much = layer_of(Layer::albedo, ball({.color = {1, 1, 1}, .diffuse = 1, .specular = 1}));
  CHECK(is_near(middle_of(too_much), {1, 1, 1}));
}

TEST_CASE("a metal's albedo is its reflectance, a plastic's its colour") {
  const Vec3d copper{0.95, 0.64, 0.54};
  for (const double metallic : {0.0, 0.5, 1.0}) {
    CAPTURE(metallic);
    const Material material{.color = copper, .microfacets = {.roughness = 0.3, .metallic = metallic}};
    CHECK(is_near(middle_of(layer_of(Layer::albedo, ball(material), true)), copper, 1e-3));
  }
}

TEST_CASE("a normal is the world's, on the eye's side, and 0 where nothing is seen") {
  const Film film = layer_of(Layer::normal, ball({}));
  CHECK(is_near(middle_of(film), {0.5, 0, 0.5}));
  CHECK(corner_of(film) == Vec3d{0.5, 0.5, 0.5});
  Scene seen_from_within = ball({});
  seen_from_within.view.from = {0, 0, 0};
  seen_from_within.view.at = {0, 1, 0};
  CHECK(is_near(middle_of(layer_of(Layer::normal, seen_from_within)), {0.5, 0, 0.5}));
}

TEST_CASE("depth is the distance from the eye in the scene's units, however large or small these are") {
  for (const double unit : {1.0, 1e-9, 1e9}) {
    CAPTURE(unit);
    Scene scene = ball({});
    scene.spheres[0].radius *= unit;
    scene.view.from = scene.view.from * unit;
    const Film film = layer_of(Layer::depth, scene);
    CHECK(middle_of(film).x == doctest::Approx(4 * unit).epsilon(1e-6));
    CHECK(corner_of(film) == Vec3d{});
  }
  Scene far = ball({});
  far.view.from = {0, -5e4, 0};
  far.view.angle_degrees = 4e-3;
  CHECK(middle_of(layer_of(Layer::depth, far)).x == doctest::Approx(5e4 - 1).epsilon(1e-6));
}

TEST_CASE("the id is that of the primitive in the pixel's middle, plus 1, with any number of samples") {
  Scene scene = ball({});
  SceneBuilder builder(scene);
  builder.sphere({0, 5, 0}, 3.5);
  const Film film = layer_of(Layer::id, scene, false, 16);
  CHECK(middle_of(film).x == 1);
  CHECK(film.samples(0) == 1);
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    CHECK(film.radiance(pixel).x == std::floor(film.radiance(pixel).x));
  }
  CHECK(film.radiance(side * side / 2 + 3).x == 2);
}

TEST_CASE("where alpha leaves something out the layer shows what is behind, in proportion; distances and numbers are whole") {
  const Vec3d veil{0.7, 0.45, 0.2}, wall{0.2, 0.4, 0.8};
  for (const double alpha : {0.0, 0.25, 0.75, 1.0}) {
    CAPTURE(alpha);
    CHECK(is_near(middle_of(layer_of(Layer::albedo, veiled(alpha))), veil * alpha + wall * (1 - alpha), 0.01));
    CHECK(is_near(middle_of(layer_of(Layer::albedo, veiled(alpha), true)), veil * alpha + wall * (1 - alpha), 0.01));
    CHECK(middle_of(layer_of(Layer::depth, veiled(alpha))).x == doctest::Approx(alpha > 0.5 ? 4 : 7).epsilon(1e-5));
  }
}

TEST_CASE("layers of means have the picture's samples, or 16 beside one that is refined") {
  Scene scene = ball({});
  CHECK(layer_of(Layer::albedo, scene, false, 5).samples(3) == 5);
  CHECK(layer_of(Layer::depth, scene, false, 5).samples(3) == 1);
  const Database database = build_database(scene, {});
  const RenderSettings refined{.header = database.header(),
                               .camera = Camera(scene.view, database.header().frame, side, side, 2),
                               .shade = {.first_samples = 2},
                               .refinement = {.error = 0.01}};
  CHECK(film_of(database, layer_settings(Layer::normal, refined)).samples(3) == 16);
}

}  // namespace layer_test
