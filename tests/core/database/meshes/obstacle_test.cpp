#include "core/database/meshes/obstacle.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "core/scene/base_meshes.h"
#include "tests/support/base_mesh_scenes.h"

namespace dmpc::tests::obstacle_test {
namespace {

using core::Obstacle;
using core::Scene;

Scene sheet(const core::Material& material = rug_material) {
  Scene scene;
  add_sheet(scene, material);
  return scene;
}

Obstacle obstacle_of(const Scene& mesh) {
  return core::obstacle_of(mesh, mesh.materials, core::faces_of_mesh(mesh, mesh.materials, 0.125, core::Parallel(1)));
}

}  // namespace

TEST_CASE("a mesh is kept unless it shines, has no triangle, or a number that no float holds") {
  CHECK(obstacle_of(sheet()) == Obstacle::none);
  CHECK(obstacle_of(sheet({.emission = {0, 1, 0}})) == Obstacle::shining);
  Scene odd = sheet();
  odd.vertices[7].y = 0.1;
  CHECK(obstacle_of(odd) == Obstacle::numbers);
  odd.vertices[7].y = double{0.1F};
  CHECK(obstacle_of(odd) == Obstacle::none);
  odd.vertices[7].y = 0x1p101;  // beside which floats have no bits of the others
  CHECK(obstacle_of(odd) == Obstacle::numbers);
  Scene flat = sheet();
  flat.vertices.assign(flat.vertices.size(), {1, 0, 0});
  CHECK(obstacle_of(flat) == Obstacle::no_triangle);
  Scene bent;
  core::SceneBuilder(bent).patch({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0.1, 1}, {0, 0, 1}});
  CHECK(obstacle_of(bent) == Obstacle::numbers);
}

TEST_CASE("a mesh of more than two million triangles is not kept") {
  const Scene scene = sheet();
  core::MeshFaces faces = core::faces_of_mesh(scene, scene.materials, 0.125, core::Parallel(1));
  faces.triangles.resize(core::base_mesh_triangles_max);
  CHECK(core::obstacle_of(scene, scene.materials, faces) == Obstacle::none);
  faces.triangles.resize(core::base_mesh_triangles_max + 1);
  CHECK(core::obstacle_of(scene, scene.materials, faces) == Obstacle::too_many_triangles);
}

TEST_CASE("places have the obstacles of their meshes, and one that lies where no grid is has one of its own") {
  const Scene scene = with_obstacles(core::Copies::left_out);
  const core::Parallel parallel(1);
  const auto obstacles = core::obstacles_of(scene, core::faces_of_meshes(scene, 0.125, parallel), parallel);
  REQUIRE(obstacles.size() == scene.kept->places.size());
  std::vector<int> counts(7);
  for (const Obstacle obstacle : obstacles) {
    ++counts[static_cast<std::size_t>(obstacle)];
  }
  CHECK(counts == std::vector<int>{13, 0, 0, 4, 4, 1, 0});
  CHECK(any_of(obstacles));
  CHECK_FALSE(core::any_of(std::vector<Obstacle>(3)));
  CHECK(core::obstacles_of(sheet(), {}, parallel).empty());
}

TEST_CASE("of many meshes that cannot be kept three are named") {
  Scene scene;
  core::BaseMeshes kept;
  kept.meshes.resize(5);
  for (std::uint32_t i = 0; i < 6; ++i) {
    kept.places.push_back({.mesh = i % 5});
  }
  scene.kept = std::make_shared<const core::BaseMeshes>(kept);
  CHECK(text_of(scene, std::vector<Obstacle>(6, Obstacle::shining)) ==
        "mesh 1 of 5, which shines, in 2 places, mesh 2 of 5, which shines, in 1 place, mesh 3 of 5, which shines, in 1 place, "
        "and 2 more");
}

}  // namespace dmpc::tests::obstacle_test
