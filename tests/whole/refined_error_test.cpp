// The error that is asked for is kept where it is hard: by what is finer than a pixel, seen directly, mirrored or as a shadow.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "core/base/sampling.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/scene/scene.h"
#include "svm/run.h"
#include "tests/support/film_error.h"

namespace dmpc::refined_error::refined_error_test {

namespace {

using namespace core;

constexpr int side = 48;
const double pixel = 2 * 10 * std::tan(0.39269908169872414) / (side - 1);

/// From 0 to 1, the same in every run.
class Numbers {
 public:
  double next() { return static_cast<double>(mix(++count_ * 0x9e3779b97f4a7c15ULL) >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  std::uint64_t count_ = 0;
};

/// Looks down at the origin from 10 away.
struct Stage {
  explicit Stage(double light, const Vec3d& from = {5, 8, 10}) : builder(scene) {
    scene.view = {.from = {0, 0, 10}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle_degrees = 45};
    builder.background({0.1, 0.2, 0.3});
    builder.light({.position = from, .color = {light, light, light}, .has_color = true});
    builder.material({.color = {0.9, 0.9, 0.9}});
  }
  void floor(const Material& material) {
    builder.material(material);
    builder.polygon({{-30, -30, -2}, {30, -30, -2}, {30, 30, -2}, {-30, 30, -2}});
    builder.material({.color = {0.9, 0.8, 0.2}});
  }
  void dots(int count, double width_pixels, double z = 0, double reach = 3.8) {
    for (int i = 0; i < count; ++i) {
      builder.sphere({numbers.between(-reach, reach), numbers.between(-reach, reach), z}, width_pixels * pixel / 2);
    }
  }
  void wires(int count, double width_pixels, double z = 0) {
    for (int i = 0; i < count; ++i) {
      const Vec3d middle{numbers.between(-3, 3), numbers.between(-3, 3), z};
      const Vec3d way{numbers.between(-3, 3), numbers.between(-3, 3), 0};
      builder.cone(middle - way, width_pixels * pixel / 2, middle + way, width_pixels * pixel / 2);
    }
  }

  Scene scene;
  SceneBuilder builder;
  Numbers numbers;
};

Scene half_pixels() {
  Stage stage(1);
  stage.dots(75, 0.5);
  return stage.scene;
}
Scene bright_tenths() {
  Stage stage(20);
  stage.dots(125, 0.1);
  return stage.scene;
}
Scene fifths() {
  Stage stage(1);
  stage.dots(250, 0.2);
  return stage.scene;
}
Scene wires() {
  Stage stage(1);
  stage.wires(12, 0.06);
  return stage.scene;
}
/// What shades lies behind the eye.
Scene thin_shadows() {
  Stage stage(1, {3, 4, 40});
  stage.floor({.color = {0.8, 0.8, 0.8}});
  stage.wires(15, 0.15, 14);
  return stage.scene;
}
Scene dots_of_shadow() {
  Stage stage(1, {3, 4, 40});
  stage.floor({.color = {0.8, 0.8, 0.8}});
  stage.dots(75, 0.5, 14, 3.5);
  return stage.scene;
}
Scene mirrored_wires() {
  Stage stage(1);
  stage.floor({.color = {0.3, 0.3, 0.3}, .diffuse = 0.3, .specular = 0.7, .shine = 20});
  stage.wires(15, 0.3, 12);
  return stage.scene;
}

/// A picture by so many samples of each pixel, or by as many as the error asks for.
svm::Report rendered(const Scene& scene, int samples, double error) {
  const Database database = build_database(scene, {});
  const RenderSettings settings{.header = database.header(),
                                .camera = Camera(scene.view, database.header().frame, side, side, samples),
                                .refinement = {.error = error}};
  return svm::run_replicated(database, settings, {.computer = {.node_count = 1}}, {});
}

void check_errors(const Scene& scene) {
  const Film truth = rendered(scene, 1000, 0).film;  // none of which a refined pixel has as many
  for (const double asked : {4.0 / 255, 2.0 / 255, 1.0 / 255}) {
    const svm::Report report = rendered(scene, 2, asked);
    const double error = tests::root_mean_square(report.film, truth);
    CAPTURE(asked);
    CAPTURE(error);
    CAPTURE(report.refinement.error);
    CHECK(error < 1.25 * asked);
    CHECK(report.refinement.error > 0.7 * error);
    CHECK(report.refinement.passes <= passes_max);
  }
}

}  // namespace

TEST_CASE("the error asked for is kept by spheres of half a pixel") { check_errors(half_pixels()); }
TEST_CASE("the error asked for is kept by bright spheres of a tenth of a pixel") { check_errors(bright_tenths()); }
TEST_CASE("the error asked for is kept by spheres of a fifth of a pixel") { check_errors(fifths()); }
TEST_CASE("the error asked for is kept by wires of a sixteenth of a pixel") { check_errors(wires()); }
TEST_CASE("the error asked for is kept by shadows of wires") { check_errors(thin_shadows()); }
TEST_CASE("the error asked for is kept by shadows of spheres") { check_errors(dots_of_shadow()); }
TEST_CASE("the error asked for is kept by wires in a mirror") { check_errors(mirrored_wires()); }

}  // namespace dmpc::refined_error::refined_error_test
