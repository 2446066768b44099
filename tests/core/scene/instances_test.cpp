#include "core/scene/instances.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::core::instances_test {

namespace {

const std::vector<Vec3d> triangle = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
const Transform up{.shift = {0, 0, 1}};
const Transform mirror{.rows = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
const Transform pressed_flat{.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}}};

/// A triangle that leans, as a patch, in these places.
Scene placed_patch(const std::vector<Transform>& places, const std::vector<Vec3d>& normals) {
  Scene scene;
  SceneBuilder builder(scene);
  builder.patch({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, normals);
  Instances instances{.meshes = {{0, 1}}};
  for (const Transform& place : places) {
    instances.places.push_back({place, 0, 1});
  }
  expand(scene, instances);
  return scene;
}

}  // namespace

TEST_CASE("each object of a mesh stands in each of its places, where the file's order has them, and the mesh itself is gone") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.diffuse = 0.1});
  builder.polygon({{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
  builder.material({.diffuse = 0.2});
  builder.polygon(triangle);
  builder.polygon({{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}});
  builder.material({.diffuse = 0.1});
  builder.polygon({{8, 0, 0}, {8, 1, 0}, {8, 0, 1}});
  expand(scene, {.meshes = {{1, 3}}, .places = {{up, 0, 3}, {Transform{}, 0, 4}}});
  REQUIRE(scene.objects.size() == 6);
  const std::vector<std::uint32_t> materials{0, 1, 1, 0, 1, 1}, corners{3, 3, 4, 3, 3, 4};
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(scene.objects[i].material == materials[i]);
    CHECK(scene.objects[i].vertex_count == corners[i]);
    CHECK(scene.objects[i].first == first);  // vertices are in the order of the objects
    first += corners[i];
  }
  CHECK(scene.vertices.size() == first);
  CHECK(scene.vertices[3] == Vec3d{0, 0, 1});
  CHECK(scene.vertices[8] == Vec3d{1, 1, 6});
  CHECK(scene.vertices[10] == Vec3d{8, 0, 0});
  CHECK(scene.vertices[14] == Vec3d{2, 0, 0});
}

TEST_CASE("meshes that stand nowhere are gone, and instances of none leave a scene as it is") {
  Scene scene;
  SceneBuilder(scene).polygon(triangle);
  expand(scene, {});
  CHECK(scene.vertices == triangle);
  expand(scene, {.meshes = {{0, 1}}});
  CHECK(scene.objects.empty());
  CHECK(scene.vertices.empty());
}

TEST_CASE("normals are placed by the inverse transpose, so that they stay upright on what is stretched") {
  const Transform stretched{.rows = {{{1, 0, 0}, {0, 4, 0}, {0, 0, 1}}}};
  const Scene scene = placed_patch({stretched}, {{0, -1, 1}, {0, -1, 1}, {0, 0, 1}});
  REQUIRE(scene.objects[0].kind == ObjectKind::patch);
  CHECK(scene.vertices[2] == Vec3d{0, 4, 1});
  CHECK(scene.normals == std::vector<Vec3d>{{0, -1, 4}, {0, -1, 4}, {0, 0, 4}});
}

TEST_CASE("a mirror keeps the side to which a face looks, by its corners and by its normals") {
  const Scene scene = placed_patch({mirror}, {{1, 0, 1}, {0, 0, 1}, {0, 1, 1}});
  CHECK(scene.vertices == std::vector<Vec3d>{{0, 1, 1}, {-1, 0, 0}, {0, 0, 0}});
  CHECK(scene.normals == std::vector<Vec3d>{{0, 1, 1}, {0, 0, 1}, {-1, 0, 1}});
}

TEST_CASE("what is pressed flat has the normals of its plane, and so has what has none but these") {
  const Scene bent = placed_patch({pressed_flat, up}, {{0, 0, 1}, {0, 0, 1}, {0, 1, 1}});
  CHECK(bent.objects[0].kind == ObjectKind::polygon);
  CHECK(bent.objects[1].kind == ObjectKind::patch);
  CHECK(bent.normals.size() == 3);
  CHECK(placed_patch({up}, std::vector<Vec3d>(3, {0, -2, 2})).objects[0].kind == ObjectKind::polygon);
  CHECK(placed_patch({up}, std::vector<Vec3d>(3, {0, 0, 1})).objects[0].kind == ObjectKind::patch);
  CHECK(placed_patch({up}, std::vector<Vec3d>(3)).objects[0].kind == ObjectKind::polygon);
}

TEST_CASE("places on a texture go with their corners") {
  Scene scene{.textures = {{.name = "t", .levels = {}}}};
  SceneBuilder builder(scene);
  builder.material({.texture = 0});
  builder.textured(triangle, {{{0, 0, 1}, {0, 0}}, {{0, 1, 1}, {1, 0}}, {{0, 0, 1}, {0, 1}}});
  expand(scene, {.meshes = {{0, 1}}, .places = {{mirror, 0, 1}, {pressed_flat, 0, 1}}});
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.corners.size() == 6);
  CHECK(scene.corners[0].place == std::array<float, 2>{0, 1});
  CHECK(scene.corners[1].normal == Vec3d{0, 1, 1});
  CHECK(scene.corners[2].place == std::array<float, 2>{0, 0});
  CHECK(scene.objects[1].first_normal == 3);
  CHECK(scene.corners[4].place == std::array<float, 2>{1, 0});
  CHECK(scene.corners[4].normal == Vec3d{});
}

TEST_CASE("what a scene takes with all its instances is known before, however much it is") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.polygon(triangle);
  builder.patch(triangle, triangle);
  Instances instances{.meshes = {{1, 2}}, .places = std::vector<Instance>(1000, Instance{up, 0, 2})};
  const ExpandedSize size = expanded_size(scene, instances);
  CHECK(size.objects == 1001);
  CHECK(size.vertices == 3003);
  CHECK(size.normals == 3000);
  CHECK(size.bytes() == 1001 * sizeof(Object) + 6003 * sizeof(Vec3d));
  scene.objects[1].vertex_count = 0xffffffffU;
  CHECK(expanded_size(scene, instances).vertices == 3 + 1000 * std::uint64_t{0xffffffffU});
  CHECK_THROWS_AS(expand(scene, instances), CapacityError);
}

}  // namespace dmpc::core::instances_test
