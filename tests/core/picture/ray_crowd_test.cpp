#include "core/picture/ray_crowd.h"

#include <doctest/doctest.h>

#include "core/picture/camera/frame_settings.h"
#include "core/picture/render.h"
#include "tests/support/film_of.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace ray_crowd_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// Balls of glass that mirrors, too, one in the other.
Scene nested_glass(int balls) {
  Scene scene;
  scene.view = {.from = {0, -3, 0.3}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 30};
  scene.background = {0.3, 0.6, 0.9};
  SceneBuilder builder(scene);
  builder.light({.position = {3, -3, 5}, .color = {1, 1, 1}, .has_color = true});
  builder.material(
      {.color = {1, 1, 1}, .diffuse = 0.1, .specular = 0.4, .shine = 20, .transmittance = 0.5, .refraction_index = 1.1});
  for (int i = 0; i < balls; ++i) {
    builder.sphere({0, 0, 0}, 1 - 0.04 * i);
  }
  return scene;
}

struct Picture {
  Database database;
  RenderSettings settings;

  Picture(const Scene& scene, int depth_max, int samples = 1)
      : database(database_of(scene)),
        settings{database.header(),
                 Camera(scene.view, database.header().frame, 6, 6, samples),
                 {.depth_max = depth_max, .first_samples = static_cast<std::uint32_t>(samples)}} {}

  /// With the rays that it took.
  std::pair<Film, std::uint64_t> rendered() const {
    Operations operations;
    Film film = film_of(database, settings, operations);
    return {std::move(film), operations.rays[1] + operations.rays[2]};
  }
};

Vec3d mean_of(const Film& film) {
  Vec3d sum;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    sum = sum + film.radiance(pixel);
  }
  return sum * (1.0 / static_cast<double>(film.pixel_count()));
}

}  // namespace

TEST_CASE("twenty balls of glass in each other at depth 20 are a crowd, and end when each hit from depth 9 on sends one ray") {
  Picture picture(nested_glass(20), 20);
  picture.settings.shade.one_child_from = find_one_child_depth(picture.database, picture.settings);
  CHECK(picture.settings.shade.one_child_from == crowd_depth);
  const auto [film, rays] = picture.rendered();
  CHECK(rays > 1000);
  CHECK(rays < 36U * 256 * 20);
}

TEST_CASE("a picture that ends anyway is no crowd: few depths, few balls, mirrors alone") {
  const auto depth_of = [](const Picture& picture) { return find_one_child_depth(picture.database, picture.settings); };
  CHECK(depth_of(Picture(nested_glass(20), 9)) == 0);
  CHECK(depth_of(Picture(nested_glass(1), 12)) == 0);
  CHECK(depth_of(Picture(mirrors_and_glass(), 10)) == 0);
  CHECK(depth_of(Picture(built_in("balls-1"), 30)) == 0);
}

TEST_CASE("whatever is left out, a picture is as much a crowd") {
  Picture mirrors(built_in("balls-3"), 30);
  for (const Skip& skip : all_skips) {
    CAPTURE(skip.name);
    mirrors.settings.skips = {};
    mirrors.settings.skips.*skip.is_on = false;
    CHECK(find_one_child_depth(mirrors.database, mirrors.settings) == 0);
    Picture glass(nested_glass(20), 20);
    glass.settings.skips.*skip.is_on = false;
    CHECK(find_one_child_depth(glass.database, glass.settings) == crowd_depth);
  }
}

TEST_CASE("a matt scene needs one entry of a ray stack, whatever the depth, and one that mirrors or transmits an entry a depth") {
  const auto waiting = [](const Scene& scene, const Skips& skips = {}) {
    const Picture picture(scene, 255);
    const RenderSettings settings = seen_by(picture.settings.camera, picture.settings, picture.database);
    CHECK(ray_depth_max(settings.shade, settings.header, skips) == waiting_hits_max(settings.shade, skips));
    return waiting_hits_max(settings.shade, skips);
  };
  CHECK(waiting(built_in("tetra-2")) == 1);
  CHECK(waiting(built_in("balls-1")) == 255);
  CHECK(waiting(nested_glass(1)) == 255);
  CHECK(waiting(built_in("tetra-2"), no_skips()) == 255);  // rays of weight 0
}

TEST_CASE("where a hit sends one of two rays the picture is right on average") {
  Picture picture(nested_glass(4), 9, 64);
  const auto [both, rays] = picture.rendered();
  picture.settings.shade.one_child_from = 3;
  const auto [one, fewer_rays] = picture.rendered();
  CHECK(fewer_rays < rays / 4);
  const Vec3d right = mean_of(both), found = mean_of(one);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    CHECK(found[channel] == doctest::Approx(right[channel]).epsilon(0.01));
  }
}

}  // namespace ray_crowd_test
