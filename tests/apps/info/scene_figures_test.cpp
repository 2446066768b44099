#include "apps/info/scene_figures.h"

#include <doctest/doctest.h>

#include <numeric>

#include "apps/scene/load_scene.h"
#include "core/scene/instances.h"
#include "tests/support/instanced_scene.h"
#include "tests/support/painted_square.h"

namespace dmpc::apps::scene_figures_test {

using core::ObjectKind;
using core::Vec3d;

namespace {

std::uint64_t count_of(const SceneFigures& figures, ObjectKind kind) { return figures.objects[static_cast<std::size_t>(kind)]; }

}  // namespace

TEST_CASE("an empty scene has nothing but a view") {
  const SceneFigures figures = figures_of(core::Scene{});
  CHECK(std::accumulate(figures.objects.begin(), figures.objects.end(), std::uint64_t{0}) == 0);
  CHECK(figures.bounds.empty());
  CHECK(figures.lights.empty());
  CHECK(figures.materials.count == 0);
  CHECK(figures.textures.empty());
}

TEST_CASE("objects are counted by kind, and bounds hold them all") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.sphere({1, 0, 0}, 2);
  builder.sphere({0, 0, 0}, 1);
  builder.cone({0, 5, 0}, 1, {0, 6, 0}, 0);
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {0, 0, -9}});
  const SceneFigures figures = figures_of(scene);
  CHECK(count_of(figures, ObjectKind::sphere) == 2);
  CHECK(count_of(figures, ObjectKind::cone) == 1);
  CHECK(count_of(figures, ObjectKind::polygon) == 1);
  CHECK(count_of(figures, ObjectKind::patch) == 0);
  CHECK(figures.bounds.low == Vec3d{-1, -2, -9});
  CHECK(figures.bounds.high == Vec3d{3, 7, 2});
}

TEST_CASE(
    "objects in several places are counted in each, and bound the scene, whether it has copies of them or leaves them out") {
  const tests::InstancedScene made = tests::instanced_scene(5);
  core::Scene expanded = made.scene, left = made.scene;
  core::expand(expanded, made.instances);
  core::leave(left, made.instances);
  const SceneFigures all = figures_of(expanded), same = figures_of(left);
  CHECK(same.objects == all.objects);
  CHECK(same.bounds.low == all.bounds.low);
  CHECK(same.bounds.high == all.bounds.high);
}

TEST_CASE("materials are counted by what they do, which may be several things") {
  core::Scene scene;
  scene.materials = {{}, {.specular = 0.5}, {.specular = 0.5, .transmittance = 0.5}, {.texture = 0}};
  const MaterialCounts materials = figures_of(scene).materials;
  CHECK(materials.count == 4);
  CHECK(materials.mirroring == 2);
  CHECK(materials.transmitting == 1);
  CHECK(materials.textured == 1);
}

TEST_CASE("lights have the colours in which they shine") {
  core::Scene scene;
  scene.lights = {{.position = {1, 2, 3}}, {.color = {1, 0, 2}, .has_color = true}, {}, {}};
  const SceneFigures figures = figures_of(scene);
  REQUIRE(figures.lights.size() == 4);
  CHECK(figures.lights[0].color == Vec3d{0.5, 0.5, 0.5});
  CHECK(figures.lights[1].color == Vec3d{1, 0, 2});
}

TEST_CASE("a texture has levels down to a texel, and tiles of 8 by 8") {
  const tests::TemporaryFolder folder;
  const SceneFigures figures = figures_of(load_scene(PictureOptions{.scene = tests::write_painted_square(folder, 16)}, {}));
  REQUIRE(figures.textures.size() == 1);
  const TextureFigures& texture = figures.textures[0];
  CHECK(texture.width == 16);
  CHECK(texture.height == 16);
  CHECK(texture.levels == 5);
  CHECK(texture.tiles == 4 + 1 + 1 + 1 + 1);
  CHECK(texture.tile_bytes == 8 * 256);
  CHECK(texture.table_bytes == 8 * 4);
  CHECK(std::string(name_of(texture.format)) == "srgb");
  CHECK(count_of(figures, ObjectKind::textured) == 2);
}

}  // namespace dmpc::apps::scene_figures_test
