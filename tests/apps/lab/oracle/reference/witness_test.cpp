#include "apps/lab/oracle/reference/witness.h"

#include <doctest/doctest.h>

#include "core/scene/scene.h"

namespace dmpc::tests::witness_test {
namespace {

using apps::ClaimedAnswer;
using apps::ReferenceRay;
using apps::Verdict;

/// A floor, and a smaller square of body 2 and 3 over its right half, at this height and rising to the right.
struct Stage {
  explicit Stage(double height, double rise = 0)
      : scene(made(height, rise)), finder(scene, {0, 0, 9}), witnesses(scene, finder) {}

  static apps::ReferenceScene made(double height, double rise) {
    core::Scene scene;
    core::SceneBuilder builder(scene);
    builder.polygon({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}});
    builder.polygon({{0, -1, height}, {1, -1, height + rise}, {1, 1, height + rise}, {0, 1, height}});
    return apps::reference_scene(scene);
  }
  static ReferenceRay down(double x) { return {.origin = {x, 0.3, 5}, .direction = {0, 0, -1}}; }
  std::uint32_t body_at(double x) const { return finder.closest(down(x)).body; }

  apps::ReferenceScene scene;
  apps::ReferenceFinder finder;
  apps::WitnessFinder witnesses;
};

TEST_CASE("a silhouette is shown by a ray as far aside as it may be, and by none farther") {
  const Stage stage(1);
  const ClaimedAnswer square{true, stage.body_at(0.01)};
  REQUIRE(square.body >= 2);
  CHECK(stage.witnesses.find(Stage::down(-0.01), square, 0.011, 0) == Verdict::silhouette);
  CHECK_FALSE(stage.witnesses.find(Stage::down(-0.01), square, 0.009, 0));
  CHECK(stage.witnesses.find(Stage::down(-1e-6), square, 0.01, 0) == Verdict::silhouette);
}

TEST_CASE("a face behind another one has no witness, however near it is, but where the two cross") {
  const Stage apart(1e-9);
  const ClaimedAnswer floor{true, apart.body_at(-0.1)};
  CHECK_FALSE(apart.witnesses.find(Stage::down(0.5), floor, 1e-3, 0.1));
  const Stage crossing(-1e-6, 2e-6);
  const ClaimedAnswer below{true, crossing.body_at(0.4)};
  REQUIRE(below.body < 2);
  REQUIRE(crossing.body_at(0.55) >= 2);
  CHECK(crossing.witnesses.find(Stage::down(0.55), below, 1e-3, 0.1) == Verdict::tie);
  CHECK_FALSE(crossing.witnesses.find(Stage::down(0.55), below, 1e-3, 0.04));
  CHECK_FALSE(crossing.witnesses.find(Stage::down(0.55), below, 1e-9, 0.1));
}

TEST_CASE("what hides a light at the end of a shadow ray is shown by one that is longer or shorter") {
  const Stage stage(1);
  ReferenceRay shadow = Stage::down(0.5);
  shadow.kind = core::RayKind::shadow;
  shadow.t_max = 4 - 1e-4;
  CHECK(stage.witnesses.find(shadow, {true}, 1e-3, 0) == Verdict::end);
  CHECK_FALSE(stage.witnesses.find(shadow, {true}, 1e-5, 0));
  shadow.t_max = 4 + 1e-4;
  CHECK(stage.witnesses.find(shadow, {false}, 1e-3, 0) == Verdict::end);
  shadow.t_max = 4.5;
  CHECK_FALSE(stage.witnesses.find(shadow, {false}, 1e-3, 0));
}

TEST_CASE("a shadow ray that would end before it starts is no witness that nothing hides the light") {
  const Stage stage(1);
  ReferenceRay shadow = Stage::down(0.5);
  shadow.kind = core::RayKind::shadow;
  shadow.t_max = 5.5;
  CHECK_FALSE(stage.witnesses.find(shadow, {false}, 6, 0));
}

TEST_CASE("a ray meets a body where it does, or between where those beside it do") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  const apps::ReferenceScene ball = apps::reference_scene(scene);
  const apps::ReferenceFinder finder(ball, {0, 0, 9});
  const apps::WitnessFinder witnesses(ball, finder);
  const ReferenceRay at_pole = {.origin = {0, 0, 5}, .direction = {0, 0, -1}};
  CHECK(witnesses.is_met(at_pole, {4, 0}, 1e-9, 0));
  CHECK_FALSE(witnesses.is_met(at_pole, {6, 0}, 1e-9, 1e-3));
  const ReferenceRay passing = {.origin = {1 + 1e-6, 0, 5}, .direction = {0, 0, -1}};
  CHECK(witnesses.is_met(passing, {5 - 1e-2, 0}, 1e-9, 1e-3));
  CHECK_FALSE(witnesses.is_met(passing, {5 - 1e-1, 0}, 1e-9, 1e-3));
  CHECK_FALSE(witnesses.is_met(passing, {5 - 1e-2, 0}, 1e-9, 1e-7));
}

}  // namespace
}  // namespace dmpc::tests::witness_test
