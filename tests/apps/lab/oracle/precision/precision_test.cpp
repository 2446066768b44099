#include "apps/lab/bench/precision/precision.h"

#include <doctest/doctest.h>

#include <numeric>
#include <string>

#include "apps/frontend/system/interrupt.h"
#include "core/base/expect.h"
#include "tests/support/checked_floor.h"
#include "tests/support/covering_faces.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::precision_test {
namespace {

apps::PictureOptions sized(int side) {
  apps::PictureOptions picture;
  picture.resolution = apps::Resolution{side, side};
  return picture;
}

TEST_CASE("a scene of flat matt surfaces has the same 8 bits in float and in double") {
  const apps::Precision precision = apps::measure_precision(built_in("tetra-4"), sized(64));
  CHECK(precision.pixels == 4096);
  CHECK(precision.primitives == 256);
  CHECK(precision.rays > 4096);
  CHECK(precision.differing_pixels == 0);
  CHECK(precision.root_mean_square > 0);
  CHECK(precision.root_mean_square < 1e-6);
  CHECK(precision.largest < 1e-5);
}

TEST_CASE("every pixel that differs has a cause") {
  apps::PictureOptions deep = sized(96);
  deep.depth = 16;  // mirrors multiply what rounding leaves until it shows
  const apps::Precision precision = apps::measure_precision(built_in("balls-3"), deep);
  CHECK(precision.differing_pixels > 5);
  CHECK(std::accumulate(precision.causes.begin(), precision.causes.end(), std::uint64_t{0}) == precision.differing_pixels);
  CHECK(precision.causes.back() == 0);
  CHECK(precision.errors.empty());
  CHECK(precision.largest_step > 0);
  CHECK(precision.largest_step <= apps::StepAudit::steps_allowed);
}

TEST_CASE("by paths nearly all pixels are as in double, with no other mean") {
  apps::PictureOptions picture = sized(64);
  picture.transport = {.kind = core::TransportKind::paths, .bounces = 3, .sky = apps::SkyChoice{{1, 1, 1}, {}}};
  picture.depth = picture.transport.depth();
  core::Scene scene = built_in("balls-2");
  scene.background = {1, 1, 1};
  const apps::Precision precision = apps::measure_precision(scene, picture);
  CHECK(precision.is_by_paths);
  CHECK(precision.differing_pixels <= 41);
  CHECK(precision.errors.empty());
  CHECK(precision.root_mean_square > 0);
}

TEST_CASE("balls, rings and lattices that mirror each other look as in double") {
  for (const char* name : {"balls-3", "rings-3", "lattice-6"}) {
    CAPTURE(std::string(name));
    const apps::Precision precision = apps::measure_precision(built_in(name), sized(128));
    CHECK(static_cast<double>(precision.differing_pixels) < 0.005 * static_cast<double>(precision.pixels));
    CHECK(precision.errors.empty());
  }
}

TEST_CASE("faces in one plane look as in double: a rug in the floor's, a glass box that stands on it") {
  for (const bool is_tilted : {false, true}) {
    for (const bool is_first : {false, true}) {
      for (const core::Scene& scene :
           {rug_on_floor(is_tilted, is_first), rug_on_floor(is_tilted, is_first, 9), glass_on_floor(is_tilted, is_first)}) {
        CAPTURE(is_tilted);
        CAPTURE(is_first);
        CAPTURE(scene.objects.size());
        const apps::Precision precision = apps::measure_precision(scene, sized(64));
        CHECK(precision.differing_pixels == 0);
        CHECK(precision.largest < 1e-5);
      }
    }
  }
}

/// A ball that mirrors, on a square that reaches so far, seen from six units away.
core::Scene ball_on_square(double half_side) {
  core::Scene scene;
  scene.background = {0.1, 0.2, 0.4};
  scene.view = {.from = {0, -6, 2.5}, .at = {0, 0, 0.4}, .up = {0, 0, 1}, .angle_degrees = 30};
  core::SceneBuilder builder(scene);
  builder.light({.position = {3, -4, 6}});
  builder.material({.color = {0.8, 0.7, 0.3}, .diffuse = 0.7, .specular = 0.3, .shine = 10});
  const double h = half_side;
  builder.polygon({{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}});
  builder.material({.color = {0.3, 0.7, 0.8}, .diffuse = 0.5, .specular = 0.5, .shine = 20});
  builder.sphere({0, 0, 0.5}, 0.5);
  return scene;
}

TEST_CASE("a ball on a square looks as in double, be it thousands or millions of times as wide") {
  for (const double half_side : {1e3, 1e6, 1e8}) {
    CAPTURE(half_side);
    const apps::Precision precision = apps::measure_precision(ball_on_square(half_side), sized(128));
    CHECK(static_cast<double>(precision.differing_pixels) < 0.001 * static_cast<double>(precision.pixels));
    CHECK(precision.errors.empty());
  }
}

TEST_CASE("a thing that is small beside a square looks as in double, wherever it stands") {
  core::Scene scene = built_in("teapot-3");
  const core::Vec3d place{1234.5, -876.5, 77};
  scene.view.from = scene.view.from + place;
  scene.view.at = scene.view.at + place;
  for (core::PointLight& light : scene.lights) {
    light.position = light.position + place;
  }
  for (core::Vec3d& vertex : scene.vertices) {
    vertex = vertex + place;
  }
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.8, 0.7, 0.3}, .diffuse = 0.7});
  const double h = 1e5, z = place.z - 0.01;
  builder.polygon({{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}});
  const apps::Precision precision = apps::measure_precision(scene, sized(128));
  CHECK(static_cast<double>(precision.differing_pixels) < 0.001 * static_cast<double>(precision.pixels));
  CHECK(precision.errors.empty());
}

TEST_CASE("an eye three thousand times the scene's extent away sees what double sees") {
  core::Scene scene = ball_on_square(1000);
  scene.view.from = {0, -6e6, 2.5e6};
  scene.view.angle_degrees = 3e-5;
  const apps::Precision precision = apps::measure_precision(scene, sized(64));
  CHECK(precision.differing_pixels <= 4);
  CHECK(precision.errors.empty());
}

TEST_CASE("an eye hundreds of millions of sizes away sees what double sees, and double sees it") {
  core::Scene scene = built_in("teapot-3");
  scene.view.from = normalize(scene.view.from - scene.view.at) * 7e8 + scene.view.at;
  scene.view.angle_degrees = 6e-7;
  const apps::Precision precision = apps::measure_precision(scene, sized(64));
  CHECK(precision.rays > 5000);
  CHECK(precision.differing_pixels <= 20);
  CHECK(precision.errors.empty());
}

TEST_CASE("a scene with textures has the same 8 bits in float and in double but where shares are rounded, and is explained") {
  const apps::Precision floor = apps::measure_precision(CheckedFloor::painted(), sized(64));
  CHECK(floor.errors.empty());
  CHECK(floor.differing_pixels < 60);  // mirrored rays have the width of their cones in two bytes
  CHECK(floor.root_mean_square < 1e-4);
  CHECK(apps::measure_precision(everything(), sized(64)).errors.empty());
}

TEST_CASE("a scene with textures looks as in double through a wide angle, too, and is explained") {
  core::Scene scene = CheckedFloor::painted();
  scene.view.angle_degrees = 135;
  const apps::Precision floor = apps::measure_precision(scene, sized(64));
  CHECK(floor.errors.empty());
  CHECK(floor.differing_pixels < 60);
  CHECK(floor.root_mean_square < 1e-4);
}

TEST_CASE("more than one sample a pixel is not measured") {
  apps::PictureOptions picture = sized(8);
  picture.samples = 2;
  CHECK_THROWS_AS(apps::measure_precision(built_in("tetra-2"), picture), core::InternalError);
}

TEST_CASE("a stop ends the measurement") {
  std::stop_source source;
  source.request_stop();
  CHECK_THROWS_AS(apps::measure_precision(built_in("tetra-2"), sized(8), {.stop = source.get_token()}), apps::Interrupted);
}

}  // namespace
}  // namespace dmpc::tests::precision_test
