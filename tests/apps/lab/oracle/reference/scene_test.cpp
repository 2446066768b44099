#include "apps/lab/oracle/reference/scene.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/small_scenes.h"

namespace dmpc::tests::reference_scene_test {
namespace {

TEST_CASE("bodies have the file's own numbers") {
  const core::Scene scene = mirrors_and_glass();
  const apps::ReferenceScene reference = apps::reference_scene(scene);
  const apps::ReferenceBody& patch = reference.bodies.back();
  CHECK(patch.place[0] == core::Vec3d{-0.4, 1.2, 0.2});
  REQUIRE(patch.is_smooth());
  CHECK(length(reference.normals[patch.first_normal]) == doctest::Approx(1).epsilon(1e-15));
  CHECK(reference.materials[patch.material].specular == 0.7);
}

TEST_CASE("lights without a colour share one and others keep theirs") {
  const apps::ReferenceScene reference = apps::reference_scene(mirrors_and_glass());
  REQUIRE(reference.lights.size() == 3);
  CHECK(reference.lights[0].intensity.x == doctest::Approx(1 / std::sqrt(3.0)).epsilon(1e-15));
  CHECK(reference.lights[2].intensity == core::Vec3d{0.9, 0.5, 0.2});
}

TEST_CASE("what cannot be hit is left out") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  builder.sphere({0, 0, 0}, 0);
  CHECK(apps::reference_scene(scene).bodies.empty());
  CHECK(apps::reference_scene(scene).size > 0);
}

}  // namespace
}  // namespace dmpc::tests::reference_scene_test
