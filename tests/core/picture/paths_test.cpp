// Light along paths, held against what can be said on paper.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "tests/support/path_studio.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"

namespace paths_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

constexpr Transport white_sky{.kind = TransportKind::paths, .has_sky = true};

/// All that reflects or lets through rays becomes matt; highlights stay.
Scene matt(Scene scene) {
  for (Material& material : scene.materials) {
    material.mirror = 0;
    material.transmittance = 0;
  }
  return scene;
}

}  // namespace

TEST_CASE("without a bounce, a sky and mirrors a picture by paths is Whitted's to the last bit") {
  Scene lit = mirrors_and_glass();
  add_textured_walls(lit);
  for (const Scene& scene : {matt(lit), matt(built_in("tetra-4")), matt(built_in("balls-2"))}) {
    CAPTURE(scene.name);
    REQUIRE(scene.background.z > 0);
    const Studio studio(scene);
    const Film film = studio.film(scaled_edge(48), 3, paths, 0);
    const std::uint64_t shadows = studio.operations.rays[static_cast<std::size_t>(RayKind::shadow)];
    CHECK(film.hash() == studio.film(scaled_edge(48), 3, {}, 4).hash());
    CHECK(shadows == studio.operations.rays[static_cast<std::size_t>(RayKind::shadow)]);
  }
}

TEST_CASE("without a bounce and a sky mirrors are as black as Whitted's at depth 1") {
  const Studio studio(mirrors_and_glass());
  CHECK(studio.film(24, 2, paths, 0).hash() == studio.film(24, 2, {}, 0).hash());
}

TEST_CASE("what is white and convex is exactly white under a white sky, however often light may bounce") {
  for (const bool is_box : {false, true}) {
    Scene scene;
    SceneBuilder builder(scene);
    builder.background({1, 1, 1});
    builder.material(grey(1));
    is_box ? add_box(builder, {-1, -1, -1}, {1, 1, 1}) : builder.sphere({0, 0, 0}, 1);
    scene.view = {.from = {3, 2, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 50};
    const Studio studio(scene);
    for (const int bounces : {0, 1, 8, 254}) {
      CAPTURE(bounces);
      const Film film = studio.film(24, 4, white_sky, bounces);
      CHECK(studio.operations.primary_hits > 24 * 24);
      for (std::uint32_t pixel = 0; pixel < 24 * 24; ++pixel) {
        REQUIRE(std::fabs(film.radiance(pixel).x - 1) < 0x1p-20);
      }
    }
  }
}

TEST_CASE("in a closed room of albedo 1/2 that shines with 1 there is 2 (1 - 2^-(b + 2)) of light after b bounces") {
  for (const bool is_ball : {false, true}) {
    const Studio studio(room(grey(0.5, 1), is_ball));
    for (const int bounces : {0, 1}) {  // before roulette there is no chance in it
      const double exact = 2 * (1 - std::ldexp(1.0, -(bounces + 2)));
      CHECK(std::fabs(studio.mean(8, 2, paths, bounces) - exact) < 1e-6);
    }
    for (const int bounces : {3, 8, 64, 254}) {
      CAPTURE(bounces);
      const double exact = 2 * (1 - std::ldexp(1.0, -(bounces + 2)));
      const Film film = studio.film(scaled_edge(48), 16, paths, bounces);
      CHECK(std::fabs(Studio::mean_of(film) - exact) < 4 * standard_error(film) + 1e-6);
      CHECK(std::fabs(Studio::mean_of(film) - exact) < (slowness == 1 ? 0.004 : 0.02));
    }
  }
}

TEST_CASE("roulette takes nothing away and gives nothing: a bright room has the sum of a geometric series") {
  const Studio studio(room(grey(0.9, 1), true));
  const int bounces = 30;
  const double exact = (1 - std::pow(0.9, bounces + 2)) / 0.1;
  const Film film = studio.film(scaled_edge(48), 16, paths, bounces);
  CHECK(std::fabs(Studio::mean_of(film) - exact) < 4 * standard_error(film));
  CHECK(standard_error(film) < 0.01 * exact * static_cast<double>(slowness));
}

TEST_CASE("a closed room without any light is black, and its paths end") {
  const Studio studio(room(grey(0.5), false));
  CHECK(studio.mean(8, 4, white_sky, 254) == 0);
  CHECK(studio.operations.ray_count() < 8 * 8 * 4 * 10);
}

TEST_CASE("where no light can be no path goes on, which is counted, and the film has the bits of one whose paths do") {
  // Albedo 1, so that no path ends by roulette.
  const Studio studio(room(grey(1), false));
  constexpr Transport black_sky{.kind = TransportKind::paths, .has_sky = true, .has_gradient = true};
  for (const Transport& transport : {paths, black_sky}) {
    const Film film = studio.film(8, 4, transport, 254);
    CHECK(studio.operations.ray_count() == 8 * 8 * 4);
    CHECK(studio.operations.skipped.zero_terms == 8 * 8 * 4);
    const Film walked = studio.film(8, 4, transport, 254, no_skips());
    CHECK(studio.operations.ray_count() > 8 * 8 * 4 * 254);
    CHECK(studio.operations.skipped.zero_terms == 0);
    CHECK(film.hash() == walked.hash());
  }
}

TEST_CASE("a mirror before a backdrop shows it though nothing lights the scene, and what scatters there goes nowhere") {
  Scene scene = seen_at_origin(floor_of({.color = {1, 1, 1}, .diffuse = 0.5, .specular = 0.5}), {0, -1, 1});
  scene.background = {0.5, 0.5, 0.5};
  const Studio studio(scene);
  const Film film = studio.film(8, 16, paths, 8), walked = studio.film(8, 16, paths, 8, no_skips());
  CHECK(film.hash() == walked.hash());
  CHECK(Studio::mean_of(film) == doctest::Approx(0.25).epsilon(0.1).scale(0));
  CHECK(Studio(floor_of(grey(0.5))).mean(8, 4, paths, 8) == 0);
}

TEST_CASE("a floor under a sky that changes upwards shows its horizon and two thirds of what the zenith has more") {
  const Studio studio(seen_at_origin(floor_of(grey(0.5)), {0, -1, 1}));
  Transport transport = white_sky;
  transport.has_gradient = true;
  transport.zenith = {4, 4, 4};
  transport.up = {0, 0, 1};
  CHECK(studio.mean(1, 4096, transport, 0) == doctest::Approx(0.5 * (1 + 3 * 2.0 / 3)).epsilon(1e-4).scale(0));
}

TEST_CASE("at a distance from an endless wall a floor sees its share of the sky") {
  constexpr double distance = 1, height = 1.5;
  Scene scene = floor_of(grey(1), 300);
  SceneBuilder builder(scene);
  builder.material(grey(0));
  builder.polygon({{distance, -4000, 0}, {distance, 4000, 0}, {distance, 4000, height}, {distance, -4000, height}});
  const Studio studio(seen_at_origin(scene, {-1, 0, 1}));
  const double exact = (1 + distance / std::sqrt(distance * distance + height * height)) / 2;
  CHECK(studio.mean(1, 16384, white_sky, 0) == doctest::Approx(exact).epsilon(0.002).scale(0));
  CHECK(studio.mean(1, 16384, white_sky, 3) == doctest::Approx(exact).epsilon(0.002).scale(0));
}

TEST_CASE("a black ball above a floor takes the cosine to it times the square of its radius over its distance") {
  Scene scene = floor_of(grey(1));
  SceneBuilder builder(scene);
  builder.material(grey(0));
  builder.sphere({0.6, 0, 1.8}, 0.5);
  const Studio studio(seen_at_origin(scene, {-1, 0, 1}));
  const double square = 0.6 * 0.6 + 1.8 * 1.8, exact = 1 - 1.8 / std::sqrt(square) * 0.25 / square;
  CHECK(studio.mean(1, 65536 / static_cast<int>(slowness), white_sky, 0) == doctest::Approx(exact).epsilon(0.001).scale(0));
}

TEST_CASE("a backdrop is seen, in mirrors too, and lights nothing; a sky does") {
  const Studio studio(seen_at_origin(floor_of(grey(1)), {0, -1, 1}));
  CHECK(studio.mean(1, 16, paths, 4) == 0);
  CHECK(studio.mean(1, 16, white_sky, 4) == doctest::Approx(1).epsilon(1e-6).scale(0));
  const Studio mirror(seen_at_origin(floor_of({.diffuse = 0, .specular = 1}), {0, -1, 1}));
  CHECK(mirror.mean(1, 16, paths, 4) == 1);
}

TEST_CASE("no sample finds more light than the bound says, by which films are scaled and checkpoints judged") {
  Scene lit = floor_of(grey(1));
  lit.lights = {{{0, 0, 9}, {1, 1, 1}, true}};
  for (Scene scene : {seen_at_origin(lit, {0, -1, 1}), mirrors_and_glass(), room(grey(0.9, 1), true), built_in("balls-2")}) {
    for (const int bounces : {0, 1, 5}) {
      CAPTURE(bounces);
      check_bounded(Studio(scene).film(8, 1, white_sky, bounces), radiance_bound(scene, bounces + 2, white_sky));
    }
  }
}

}  // namespace paths_test
