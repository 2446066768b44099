// The error that is asked for is kept by light along paths, whose samples are noise.
#include <doctest/doctest.h>

#include <cstdint>
#include <utility>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/scene/scene.h"
#include "svm/run.h"
#include "tests/support/film_error.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"

namespace dmpc::refined_paths_test {

namespace {

using namespace core;
using tests::scaled_edge, tests::slowness;

constexpr int side = scaled_edge(32);
/// Samples of the pictures that errors are measured against: refined pictures have about forty, so that the error of these is
/// negligible.
constexpr int true_samples = 512;
/// Bounds of the estimate over the error. Few pixels tell little of either.
constexpr double least_estimate = slowness == 1 ? 0.8 : 0.5, most_estimate = slowness == 1 ? 1.25 : 2.0;
constexpr Transport under_sky{.kind = TransportKind::paths, .has_sky = true};

struct PathScene {
  Scene scene;
  Transport transport = under_sky;
  int bounces = 3;
  int side = refined_paths_test::side;
};

/// A picture by so many samples of each pixel, or by as many as the error asks for.
svm::Report rendered(const PathScene& subject, int samples, double error) {
  const Database database = build_database(subject.scene, {});
  const ShadeOptions shade{.depth_max = subject.bounces + 1,
                           .first_samples = static_cast<std::uint32_t>(samples),
                           .film_scale = {},
                           .transport = subject.transport};
  const RenderSettings settings{
      .header = database.header(),
      .camera = Camera(subject.scene.view, database.header().frame, subject.side, subject.side, samples),
      .shade = shade,
      .refinement = {.error = error, .kind = ErrorKind::noise}};
  return svm::run_replicated(database, settings, {.computer = {.node_count = 1}}, {});
}

svm::Report refined(const PathScene& subject, double error) {
  return rendered(subject, static_cast<int>(first_refined_samples(ErrorKind::noise)), error);
}

double mean_of(const Film& film) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    sum += film.radiance(pixel).x;
  }
  return sum / static_cast<double>(film.pixel_count());
}

/// Returns the refined picture.
Film check_error(const PathScene& subject, const Film& truth, double asked) {
  svm::Report report = refined(subject, asked);
  const double error = tests::root_mean_square(report.film, truth);
  CAPTURE(error);
  CAPTURE(report.refinement.error);
  CAPTURE(report.refinement.passes);
  CHECK(report.refinement.error > least_estimate * error);
  CHECK(report.refinement.error < most_estimate * error);
  CHECK(report.refinement.passes > 1);
  CHECK(report.refinement.passes < passes_max);
  return std::move(report.film);
}

void check_error(const PathScene& subject, double asked) { check_error(subject, rendered(subject, true_samples, 0).film, asked); }

Scene white_background(Scene scene) {
  scene.background = {1, 1, 1};
  return scene;
}

/// A ball that shines in a closed room, both of albedo 1/2.
Scene furnace() {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.color = {0.5, 0.5, 0.5}, .diffuse = 1});
  builder.sphere({0, 0, 0}, 4);
  builder.material({.color = {0.5, 0.5, 0.5}, .diffuse = 1, .emission = {8, 8, 8}});
  builder.sphere({1, 1, 2}, 0.6);
  scene.view = {.from = {0.2, 0.1, 0}, .at = {1, 2, 3}, .up = {0, 1, 0}, .angle_degrees = 80};
  return scene;
}

}  // namespace

TEST_CASE("the estimate of a picture by paths is within 0.8 and 1.25 of its error: balls under a white sky") {
  check_error({white_background(tests::built_in("balls-2"))}, 8.0 / 255);
}
TEST_CASE("the estimate of a picture by paths is within 0.8 and 1.25 of its error: rings under a sky that changes upwards") {
  Transport transport = under_sky;
  transport.has_gradient = true;
  transport.zenith = {0.1F, 0.3F, 2.0F};
  check_error({white_background(tests::built_in("rings-2")), transport}, 8.0 / 255);
}
TEST_CASE("the estimate of a picture by paths is within 0.8 and 1.25 of its error: mountains, one bounce, few pixels") {
  check_error({white_background(tests::built_in("mount-4")), under_sky, 1, side * 3 / 4}, 4.0 / 255);
}
TEST_CASE("the estimate of a room that a small ball lights is that good, too, and it stays as bright as it is, as far as 1.5 %" *
          doctest::test_suite("slow")) {
  const PathScene subject{furnace(), {.kind = TransportKind::paths}, 4};
  // The picture has some of its samples in common with this one, and takes hundreds where the ball is not seen.
  const Film truth = rendered(subject, 4 * true_samples, 0).film;
  const double mean = mean_of(truth), share = slowness == 1 ? 0.015 : 0.06;
  CHECK(mean_of(check_error(subject, truth, 8.0 / 255)) == doctest::Approx(mean).epsilon(share));
}

TEST_CASE("a closed room that shines with 1 has its exact mean, as far as 1.5 %, when it is refined") {
  Scene scene = furnace();
  scene.materials[0].emission = scene.materials[1].emission = {1, 1, 1};
  for (const double asked : {16.0 / 255, 4.0 / 255}) {
    const svm::Report report = refined({scene, {.kind = TransportKind::paths}, 4}, asked);
    CHECK(mean_of(report.film) == doctest::Approx(2 * (1 - 0x1p-6)).epsilon(0.015));
  }
}

}  // namespace dmpc::refined_paths_test
