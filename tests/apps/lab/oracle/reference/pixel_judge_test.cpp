#include "apps/lab/oracle/reference/pixel_judge.h"

#include <doctest/doctest.h>

#include <array>
#include <utility>

#include "tests/apps/lab/oracle/reference/workbench.h"
#include "tests/support/checked_floor.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests::pixel_judge_test {
namespace {

using apps::PixelCause;

/// How many pixels have which cause, whether their bytes differ or not.
struct Causes : std::array<std::uint32_t, apps::pixel_cause_count> {
  explicit Causes(const Workbench& bench, const core::RoundingLoss& loss = {}) : Causes(bench, bench.picture(), loss) {}
  Causes(const Workbench& bench, const core::Film& picture, const core::RoundingLoss& loss = {}) : array{} {
    const apps::PixelJudge judge(bench.database, bench.settings, bench.reference, bench.finder, bench.camera, loss);
    for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
      const apps::Judgement judgement = judge.judge(pixel, picture.radiance(pixel));
      ++at(static_cast<std::size_t>(judgement.cause));
      CHECK(judgement.error.empty() == (judgement.cause != PixelCause::unexplained));
    }
  }
  std::uint32_t of(PixelCause cause) const { return at(static_cast<std::size_t>(cause)); }
};

TEST_CASE("where both renderers meet the same surfaces the cause is rounding") {
  const Workbench bench(built_in("tetra-3"), 24);
  CHECK(Causes(bench).of(PixelCause::rounding) == bench.pixel_count());
}

TEST_CASE("mirrors that multiply rounding part the renderers at silhouettes and terminators, all of them explained") {
  Workbench bench(built_in("balls-3"), 64);
  bench.settings.shade.depth_max = 12;
  const Causes causes(bench);
  CHECK(causes.of(PixelCause::silhouette) > 0);
  CHECK(causes.of(PixelCause::shadow_silhouette) + causes.of(PixelCause::terminator) > 0);
  CHECK(causes.of(PixelCause::unexplained) == 0);
}

TEST_CASE("what hits show of an ambient light is explained, and one more of it is not") {
  core::Scene scene = mirrors_and_glass();
  add_textured_walls(scene);
  scene.ambient = {0.5, 0.25, 1};
  const Workbench bench(scene, 32);
  CHECK(Causes(bench).of(PixelCause::unexplained) == 0);
  core::Scene other = scene;
  other.ambient.x = 0.501;
  CHECK(Causes(Workbench(scene, other, 32)).of(PixelCause::unexplained) > 100);
}

/// A smaller polygon at distance `before` in front of another one, rising from left to right.
core::Scene two_polygons(double before, double rise) {
  core::Scene scene;
  scene.view = {.from = {0.1, 0.2, 6}, .at = {0, 0, 1}, .up = {0, 1, 0}, .angle_degrees = 20};
  core::SceneBuilder builder(scene);
  builder.polygon({{-0.5, -0.7, 1 + before - 0.5 * rise}, {0.6, -0.7, 1 + before + 0.6 * rise}, {0, 0.8, 1 + before}});
  builder.polygon({{-1, -1, 1}, {1, -1, 1}, {0.2, 1.3, 1}});
  return scene;
}

TEST_CASE("two polygons that all but touch are a tie where they cross within a pixel") {
  const Causes causes(Workbench(two_polygons(0, 1e-5), 24));
  CHECK(causes.of(PixelCause::tie) > 0);
  CHECK(causes.of(PixelCause::unexplained) == 0);
}

TEST_CASE("two polygons that do not cross are in the wrong order, and no tie, however near they are to each other") {
  constexpr double hair = 1e-8;  // less than floats can tell
  const Causes causes(Workbench(two_polygons(hair, 0), two_polygons(-hair, 0), 24));
  CHECK(causes.of(PixelCause::tie) == 0);
  CHECK(causes.of(PixelCause::unexplained) > 50);
}

TEST_CASE("what is farther off than pixels may be is unexplained without a warning, and warned with one that covers it") {
  core::Scene scene = two_polygons(0.5, 0);
  scene.background = {0.2, 0.3, 0.4};
  scene.view.at = scene.vertices[0] * 0.43 + scene.vertices[2] * 0.57;
  scene.view.angle_degrees = 2e-5;  // pixels are 7e-8 apart
  const Workbench bench(scene, 24);
  CHECK(Causes(bench).of(PixelCause::unexplained) > 0);
  const Causes warned(bench, core::find_rounding_loss(bench.database, bench.settings.camera));
  CHECK(warned.of(PixelCause::unexplained) == 0);
  CHECK(warned.of(PixelCause::warned) > 0);
  CHECK(Causes(bench, {.swapped = 1, .swapped_pixels = 2}).of(PixelCause::unexplained) == 0);
}

TEST_CASE("a pixel that is not as bright as its rays make it is unexplained, and one that is off by a step of the film is not") {
  const Workbench bench(mirrors_and_glass(), 16);
  const apps::PixelJudge judge(bench.database, bench.settings, bench.reference, bench.finder, bench.camera);
  const core::Film picture = bench.picture();
  for (std::uint32_t pixel = 0; pixel < bench.pixel_count(); ++pixel) {
    const core::Vec3d radiance = picture.radiance(pixel);
    REQUIRE(judge.judge(pixel, radiance + core::Vec3d{0, picture.step() / 4, 0}).error == "");
    REQUIRE(judge.judge(pixel, radiance + core::Vec3d{0, 1e-6, 0}).error == "its light is not that of its rays");
  }
}

TEST_CASE("a part of the picture that is taken for background and is none is unexplained") {
  Workbench bench(mirrors_and_glass(), 24);
  core::BackgroundTiles::Bits all;
  all.fill(~std::uint64_t{0});
  bench.settings.background = core::BackgroundTiles(bench.settings.camera, all);
  REQUIRE(bench.settings.shows_background(0));
  CHECK(Causes(bench).of(PixelCause::unexplained) > bench.pixel_count() / 2);
}

TEST_CASE("another surface than the scene's is unexplained") {
  const core::Scene scene = mirrors_and_glass();
  core::Scene other = scene;
  other.spheres[1].radius *= 1.001;
  CHECK(Causes(Workbench(scene, other, 24)).of(PixelCause::unexplained) > 10);
}

TEST_CASE("another light than the scene's is unexplained") {
  const core::Scene scene = mirrors_and_glass();
  core::Scene other = scene;
  other.lights[2].color.x += 0.01;
  CHECK(Causes(Workbench(scene, other, 24)).of(PixelCause::unexplained) > 10);
}

TEST_CASE("textures part the renderers by rounding alone") {
  for (const core::Scene& scene : {CheckedFloor::painted(), everything()}) {
    CHECK(Causes(Workbench(scene, 24)).of(PixelCause::unexplained) == 0);
  }
}

TEST_CASE("another place on a texture and another texture are unexplained") {
  const core::Scene scene = CheckedFloor::painted();
  core::Scene exchanged = scene, darker = scene;
  for (core::TexturedCorner& corner : exchanged.corners) {
    std::swap(corner.place[0], corner.place[1]);
  }
  for (core::TextureLevel& level : darker.textures[0].levels) {
    for (std::uint32_t& texel : level.texels) {
      texel &= 0xfefefeU;
    }
  }
  CHECK(Causes(Workbench(scene, exchanged, 24)).of(PixelCause::unexplained) > 100);
  CHECK(Causes(Workbench(scene, darker, 24)).of(PixelCause::unexplained) > 100);
}

}  // namespace
}  // namespace dmpc::tests::pixel_judge_test
