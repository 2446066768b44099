#include <doctest/doctest.h>

#include <cmath>

#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/scene/frame.h"
#include "tests/support/small_scenes.h"

namespace grid_axes_test {

namespace {

using namespace dmpc;

core::Film picture_of(const core::Scene& scene, const core::GridAxes& axes) {
  core::BuildOptions options;
  options.axes = axes;
  const core::Database database = core::build_database(scene, options);
  core::LocalRecords records(database.bytes());
  core::GridTracer tracer(records, database.header(), core::Skips{});
  core::Operations operations;
  return core::render(tracer, {database.header(), core::Camera(scene.view, database.header().frame, 48, 48, 1), {}}, operations);
}

}  // namespace

TEST_CASE("the screen's axes are a right-handed frame with x to the right and y up") {
  const core::Scene scene = tests::mirrors_and_glass();
  const core::GridAxes axes = core::screen_axes(scene.view);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(core::dot(axes[i], axes[i]) == doctest::Approx(1));
    CHECK(std::fabs(core::dot(axes[i], axes[(i + 1) % 3])) < 1e-15);
  }
  CHECK(core::dot(core::cross(axes[0], axes[1]), axes[2]) == doctest::Approx(1));
  CHECK(core::dot(axes[1], scene.view.up) > 0);
  CHECK(core::dot(axes[2], scene.view.at - scene.view.from) < 0);
}

TEST_CASE("a direction in the world's axes keeps its bits") {
  const core::Vec3d v{0.1, -1e-300, 12345.678};
  CHECK(core::turned(core::world_axes, v) == v);
}

TEST_CASE("a grid along the screen's axes gives the same picture to rounding") {
  const core::Scene scene = tests::mirrors_and_glass();
  const core::Film world = picture_of(scene, core::world_axes), screen = picture_of(scene, core::screen_axes(scene.view));
  CHECK(world.hash() != screen.hash());
  int far_apart = 0;
  for (std::uint32_t pixel = 0; pixel < world.pixel_count(); ++pixel) {
    const core::Vec3d difference = world.radiance(pixel) - screen.radiance(pixel);
    far_apart += core::length(difference) > 1e-3 ? 1 : 0;
  }
  CHECK(far_apart <= 3);  // of 2,304 pixels: silhouettes
}

}  // namespace grid_axes_test
