// How a point light's strength changes, in eight bytes, and what pictures show of it.
#include "core/record/light_spread.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/elementary.h"
#include "tests/support/path_studio.h"

namespace light_spread_test {

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

const double pi = std::acos(-1);

/// From the light, so many degrees from `ahead`, which is not x.
Vec3d turned(const Vec3d& ahead, double degrees) {
  const Vec3d across = normalize(cross(ahead, {1, 0, 0}));
  return ahead * cos_degrees(degrees) + across * sin_degrees(degrees);
}

/// A white matt square of side 2 about the middle, seen from above, lit by nothing but this light.
Scene card(const PointLight& light) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.color = {0.5, 0.5, 0.5}});
  builder.polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  scene.lights = {light};
  scene.view = {.from = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 1};
  return scene;
}

}  // namespace

TEST_CASE("a light that falls off is weaker by the square of the distance, and one as NFF has it is not") {
  CHECK(share_of({}, {0, 0, 1}, 7) == 1);
  const LightSpread falling = spread_of({}, true);
  CHECK(!falling.is_plain());
  CHECK(!falling.is_cone());
  CHECK(share_of(falling, {0, 0, 1}, 4) == 0.0625);
  CHECK(spread_of({}, false).is_plain());
}

TEST_CASE("a cone shines ahead, and is dark beyond its end, whatever its direction and width") {
  for (const Vec3d& way : {Vec3d{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {-0.3, 0.5, -0.7}, {0.2, -0.9, 0.1}}) {
    const Vec3d ahead = normalize(way);
    for (const double degrees : {1.0, 10.0, 45.0, 90.0, 150.0}) {
      CAPTURE(degrees);
      const LightSpread spread = spread_of({.ahead = ahead, .full_degrees = degrees * 0.5, .none_degrees = degrees}, false);
      CHECK(share_of(spread, -turned(ahead, degrees * 0.4), 9) == 1);
      CHECK(share_of(spread, -turned(ahead, degrees * 1.1), 9) == 0);
      const double full = cos_degrees(degrees * 0.5), none = cos_degrees(degrees);
      const double t = (cos_degrees(degrees * 0.75) - none) / (full - none);
      CHECK(share_of(spread, -turned(ahead, degrees * 0.75), 9) == doctest::Approx(t).epsilon(0.02));
    }
  }
}

TEST_CASE("a smooth cone goes from full to none as 3 t^2 - 2 t^3, and one of half a sphere by the cosine") {
  const Vec3d ahead{0, 0, -1};
  const LightSpread smooth = spread_of({.ahead = ahead, .full_degrees = 25, .none_degrees = 30, .edge = ConeEdge::smooth}, true);
  const double t = (cos_degrees(28) - cos_degrees(30)) / (cos_degrees(25) - cos_degrees(30));
  CHECK(share_of(smooth, -turned(ahead, 28), 2) == doctest::Approx(t * t * (3 - 2 * t) / 4).epsilon(0.01));
  const LightSpread half = spread_of({.ahead = ahead, .full_degrees = 0, .none_degrees = 90}, false);
  CHECK(share_of(half, -turned(ahead, 60), 1) == doctest::Approx(0.5).epsilon(0.001));
  CHECK(share_of(half, -turned(ahead, 91), 1) == 0);
}

// Its angles have changed places in the record, so that those of 0 and of all, and equal ones, are to be told apart, too.
TEST_CASE("a square cone goes from full to none as t^2, also one that is full ahead alone, and one without an edge is sharp") {
  const Vec3d ahead{0, 0, -1};
  const auto share = [&](double full, double none, double degrees) {
    const LightCone cone{.ahead = ahead, .full_degrees = full, .none_degrees = none, .edge = ConeEdge::square};
    return share_of(spread_of(cone, true), -turned(ahead, degrees), 2) * 4;
  };
  for (const double full : {0.0, 20.0}) {
    CAPTURE(full);
    const double t = (cos_degrees(25) - cos_degrees(30)) / (cos_degrees(full) - cos_degrees(30));
    CHECK(share(full, 30, 25) == doctest::Approx(t * t).epsilon(0.01));
    CHECK(share(full, 30, full * 0.9) == doctest::Approx(1));
    CHECK(share(full, 30, 31) == 0);
  }
  CHECK(share(30, 30, 29.9) == 1);
  CHECK(share(30, 30, 30.1) == 0);
  CHECK(share(40, 30, 30.1) == 0);
}

// R I cos / (pi d^2), straight below: 0.5 * 10 / pi / 4. Nothing is seen of a light that stands before the eye.
TEST_CASE("by paths a point that falls off lights as the inverse square says, and is not seen") {
  const double shown = 0.5 * 10 / pi / 4;
  PointLight light{{0, 0, 2}, Vec3d{10, 10, 10} * (1 / pi), true};
  light.falls_off_from = 0.01;
  CHECK(Studio(card(light)).mean(4, 1, paths, 2) == doctest::Approx(shown).epsilon(1e-3));
  Scene large = card(light);
  SceneBuilder builder(large);
  builder.polygon({{-5000, -5000, -30}, {5000, -5000, -30}, {5000, 5000, -30}, {-5000, 5000, -30}});
  CHECK(Studio(large).mean(4, 1, paths, 0) == doctest::Approx(shown).epsilon(1e-3));
  light.cone = {.ahead = {0, 0, -1}, .full_degrees = 5, .none_degrees = 10, .edge = ConeEdge::smooth};
  CHECK(Studio(card(light)).mean(4, 1, paths, 0) == doctest::Approx(shown).epsilon(1e-3));
  light.cone.ahead = {1, 0, 0};
  CHECK(Studio(card(light)).mean(4, 1, paths, 0) == 0);
  light.cone = {
      .ahead = {0, sin_degrees(20), -cos_degrees(20)}, .full_degrees = 10, .none_degrees = 40, .edge = ConeEdge::square};
  const double t = (cos_degrees(20) - cos_degrees(40)) / (cos_degrees(10) - cos_degrees(40));
  CHECK(Studio(card(light)).mean(4, 1, paths, 0) == doctest::Approx(shown * t * t).epsilon(2e-3));
}

}  // namespace light_spread_test
