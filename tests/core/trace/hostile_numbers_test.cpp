// NaN, infinity, numbers near the end of the range and denormal ones: a miss or a dropped primitive, never a hang or a crash.
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "core/picture/render.h"
#include "tests/support/film_of.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace hostile_numbers_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

Scene small_scene() {
  Scene scene = scene_of(sphere_mesh(6, 8, 0.1));
  SceneBuilder builder(scene);
  builder.sphere({1.5, 0, 0}, 0.3);
  builder.cone({0, 1.5, 0}, 0.3, {0, 2, 0}, 0.1);
  builder.light({.position = {0, 0, 5}});
  return seen_from(scene, 1);
}

Vec3d odd_point(Random& random) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 10> values{none, endless, -endless, 1e308, -1e308, 3e38, 1e-320, 0.0, -0.0, 1e29};
  const auto one = [&] { return random.bits() % 2 == 0 ? random.between(-1, 1) : values[random.below(values.size())]; };
  const double x = one(), y = one();
  return {x, y, one()};
}

/// Renders a few pixels: every ray must come to an end.
void render_small(const Database& database, const View& view) {
  CHECK(film_of(database, {database.header(), Camera(view, database.header().frame, 8, 8, 1), {}}).pixel_count() == 64);
}

}  // namespace

TEST_CASE("a ray without a direction or without a length misses") {
  const Database database = database_of(small_scene());
  const Vec3f middle(to_local(database.header().frame, {0, 0, 0}));
  CHECK_FALSE(shoot(database, ray_from(middle, {0, 0, 0})).found());
  CHECK_FALSE(shoot(database, ray_from(middle, {1e-40F, 1e-40F, 1e-40F})).found());
  for (const float t_max : {0.0F, -1.0F, nan_value}) {
    Ray ray = ray_from(middle, {1, 0, 0});
    ray.t_max = t_max;
    CHECK_FALSE(shoot(database, ray).found());
  }
}

TEST_CASE("primitives that are not finite are dropped and counted") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  Scene scene;
  SceneBuilder builder(scene);
  for (const double bad : {none, endless, -endless, 1e31, -1e308}) {
    builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, bad, 0}});
    builder.sphere({bad, 0, 0}, 1);
    builder.sphere({0, 0, 0}, bad);
    builder.cone({0, 0, bad}, 1, {0, 0, 1}, 1);
    builder.cone({0, 0, 0}, bad, {0, 0, 1}, 1);
    builder.cone({0, 0, 0}, 1, {0, 0, 1}, bad);
  }
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Database database = database_of(scene);
  CHECK(database.dropped() == 30);
  CHECK(database.primitives().size() == 1);
}

TEST_CASE("scenes of any numbers are built and rendered to the end") {
  for (std::uint64_t seed = 0; seed < scaled(200); ++seed) {
    Random random(seed);
    Scene scene;
    SceneBuilder builder(scene);
    builder.light({.position = odd_point(random)});
    builder.material(
        {.specular = 0.5, .shine = odd_point(random).x, .transmittance = 0.5, .refraction_index = odd_point(random).y});
    for (int i = 0; i < 5; ++i) {
      builder.polygon({odd_point(random), odd_point(random), odd_point(random)});
      builder.patch({random.in_box(-1, 1), random.in_box(-1, 1), random.in_box(-1, 1)},
                    {odd_point(random), odd_point(random), odd_point(random)});
      builder.sphere(odd_point(random), odd_point(random).x);
      builder.cone(odd_point(random), odd_point(random).x, odd_point(random), odd_point(random).y);
      builder.sphere(random.in_box(-1, 1), random.unit());
    }
    scene.view.from = seed % 2 == 0 ? Vec3d{0, 0, 5} : odd_point(random);
    const Database database = database_of(scene);
    CHECK(database.primitives().size() + database.dropped() == scene.objects.size());
    render_small(database, scene.view);
  }
}

}  // namespace hostile_numbers_test
