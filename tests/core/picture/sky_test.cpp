// Paths below a sky's picture, held against what can be said on paper.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/picture/shade.h"
#include "tests/support/path_studio.h"
#include "tests/support/scaled.h"
#include "tests/support/sky_pictures.h"

namespace sky_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

using std::numbers::pi;

constexpr Transport below_sky{.kind = TransportKind::paths, .has_sky = true};
constexpr Transport aiming_alone{.kind = TransportKind::paths, .has_sky = true, .only_aims = true};
constexpr Transport meeting_alone{.kind = TransportKind::paths, .has_sky = true, .never_aims = true};

Scene below(const SkyTexels& sky, Scene scene) {
  scene.background = {};
  scene.sky = sky;
  return scene;
}

/// Over pi, of a floor below a sun that is the middle of a texel of a picture so wide, and falls to nothing at its neighbours':
/// a tent over angles, whose integral with the sine and the cosine of the height is elementary.
double irradiance_of_sun(std::uint32_t width, std::uint32_t row, double light) {
  const double step = 2 * pi / width, from_zenith = (row + 0.5) * step;
  return light * step * std::sin(2 * from_zenith) * std::sin(step) * std::sin(step) / (2 * step) / pi;
}

/// A ball on a floor.
Scene ball_on_floor(const Material& material) {
  Scene scene = floor_of(material);
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 1}, 1);
  scene.view = {.from = {0, -5, 2}, .at = {0, 0, 0.7}, .up = {0, 0, 1}, .angle_degrees = 45};
  return scene;
}

}  // namespace

TEST_CASE("a floor below a sun of one texel has the light that its tent of rays brings, however it is found") {
  for (const auto& [column, row] : {std::pair{40U, 10U}, std::pair{0U, 5U}, std::pair{63U, 2U}}) {
    CAPTURE(row);
    const Studio studio(below(one_bright_texel(64, column, row, 1000, 0), seen_at_origin(floor_of(grey(0.8)), {-3, 0, 0.5})));
    const double exact = 0.8 * irradiance_of_sun(64, row, 1000);
    CHECK(studio.mean(1, 4096, below_sky, 0) == doctest::Approx(exact).epsilon(0.002).scale(0));
    CHECK(studio.mean(1, 4096, aiming_alone, 0) == doctest::Approx(exact).epsilon(0.002).scale(0));
    CHECK(studio.mean(1, 1 << 14, meeting_alone, 0) == doctest::Approx(exact).epsilon(0.1).scale(0));
  }
}

TEST_CASE("below a picture that is white all over but for a texel in the ground what is white and convex is white") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material(grey(1));
  builder.sphere({0, 0, 0}, 1);
  scene.view = {.from = {0, -2, 1.5}, .at = {0, 0, 0.9}, .up = {0, 0, 1}, .angle_degrees = 10};
  const Studio studio(below(one_bright_texel(64, 3, 31, 0.5F, 1), scene));
  for (const int bounces : {0, 1, 8, 253}) {
    CAPTURE(bounces);
    const Film film = studio.film(scaled_edge(16), 64, below_sky, bounces);
    CHECK(studio.operations.primary_hits > 0);
    CHECK(std::fabs(Studio::mean_of(film) - 1) < 4 * standard_error(film) + 0.002);  // the texel is some 0.05 % of the sky
  }
  const Film met = studio.film(scaled_edge(16), 4, meeting_alone, 1);
  double least = 1, most = 1;
  for (std::uint32_t pixel = 0; pixel < met.pixel_count(); ++pixel) {
    least = std::min(least, double{met.radiance(pixel).x});
    most = std::max(most, double{met.radiance(pixel).x});
  }
  CHECK(most < 1 + 0x1p-20);  // each sample is 1, but where the texel is met
  CHECK(least > 0.5);
}

TEST_CASE("to aim at a sky alone, to meet it by chance alone, and both, weighed, have one mean; both vary little more" *
          doctest::test_suite("slow")) {
  const int side = scaled_edge(16), samples = 64;
  Material rough = grey(0.7);
  rough.microfacets = {.roughness = 0.4, .metallic = 1};
  for (const float sun : {0.0F, 300.0F}) {
    for (const Material& material : {grey(0.7), rough}) {
      for (const int bounces : {0, 2}) {
        CAPTURE(sun);
        CAPTURE(bounces);
        const Studio studio(below(sunny_texels(48, sun), ball_on_floor(material)));
        WaysToLight{.reference = studio.square(side, 1024, bounces, 3, below_sky),
                    .both = studio.square(side, samples, bounces, 1, below_sky),
                    .aimed = studio.square(side, samples, bounces, 1, aiming_alone),
                    .met = studio.square(side, samples, bounces, 1, meeting_alone)}
            .check(slowness != 1 ? 3
                   : sun > 0     ? 1.25
                                 : 1.75);  // half of what is aimed at lies below the floor
      }
    }
  }
}

TEST_CASE("the eye, a mirror and glass see a picture's sky as it is") {
  Scene scene = floor_of({.diffuse = 0, .specular = 1});
  scene.view = {.from = {-1, 0, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 1e-3};
  const SkyTexels sky = one_bright_texel(64, 32, 15, 8, 4);
  CHECK(Studio(below(sky, scene)).mean(1, 16, below_sky, 4) == doctest::Approx(4));
  scene.view.at = {-1, 1, 1};
  CHECK(Studio(below(sky, scene)).mean(1, 16, below_sky, 0) == doctest::Approx(4));
  scene.view.at = {0, -std::tan(pi / 64), 1 + std::tan(pi / 64)};  // to the middle of the texel
  CHECK(Studio(below(sky, scene)).mean(1, 16, below_sky, 0) == doctest::Approx(8).epsilon(0.01).scale(0));
}

TEST_CASE("no sample finds more light than the bound says below a picture with a sun") {
  for (const int bounces : {0, 1, 5}) {
    const Scene scene = below(sunny_texels(48, 300), ball_on_floor(grey(0.9)));
    check_bounded(Studio(scene).film(24, 1, below_sky, bounces), radiance_bound(scene, bounces + 2, below_sky));
  }
}

TEST_CASE("a closed room below a picture is black, and nobody within sees it") {
  const Studio studio(below(sunny_texels(32), room(grey(0.5), false)));
  CHECK(studio.mean(8, 4, below_sky, 253) == 0);
}

}  // namespace sky_test
