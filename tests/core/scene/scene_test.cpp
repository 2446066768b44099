#include "core/scene/scene.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/base/expect.h"

namespace scene_scene_test {

using namespace dmpc::core;

namespace {

const std::vector<Vec3d> small_triangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<Vec3d> square = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Vec3d> upright = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}};

Material red() { return {.color = {1, 0, 0}}; }
Material green() { return {.color = {0, 1, 0}}; }

/// Notes the order of what arrives: a letter an entity.
struct Notes final : SceneSink {
  std::string text;
  void background(const Vec3d&) override { text += 'b'; }
  void view(const View&) override { text += 'v'; }
  void light(const PointLight&) override { text += 'l'; }
  void material(const Material&) override { text += 'f'; }
  void polygon(const std::vector<Vec3d>& vertices) override { text += std::to_string(vertices.size()); }
  void patch(const std::vector<Vec3d>&, const std::vector<Vec3d>&) override { text += 'n'; }
  void sphere(const Vec3d&, double) override { text += 's'; }
  void cone(const Vec3d&, double, const Vec3d&, double) override { text += 'c'; }
};

}  // namespace

TEST_CASE("a builder that gets nothing leaves the scene empty") {
  Scene scene;
  SceneBuilder builder(scene);
  CHECK(scene.objects.empty());
  CHECK(scene.materials.empty());
}

TEST_CASE("objects keep the order of the file and find their data in the pool of their kind") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.polygon(square);
  builder.sphere({1, 2, 3}, 4);
  builder.patch(small_triangle, upright);
  builder.cone({0, 0, 0}, 2, {0, 0, 1}, 1);
  builder.polygon(small_triangle);
  builder.sphere({5, 6, 7}, -8);

  REQUIRE(scene.objects.size() == 6);
  CHECK(scene.objects[0].kind == ObjectKind::polygon);
  CHECK(scene.objects[0].vertex_count == 4);
  CHECK(scene.objects[2].kind == ObjectKind::patch);
  CHECK(scene.vertices[scene.objects[2].first + 1] == small_triangle[1]);
  CHECK(scene.normals[scene.objects[2].first_normal + 2] == upright[2]);
  CHECK(scene.cones[scene.objects[3].first].base_radius == 2);
  CHECK(scene.vertices[scene.objects[4].first + 2] == small_triangle[2]);
  CHECK(scene.spheres[scene.objects[5].first].radius == -8);
  CHECK(scene.vertices.size() == 10);
}

TEST_CASE("objects before the first material get the default material") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({}, 1);
  builder.material(red());
  builder.sphere({}, 1);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[scene.objects[0].material] == Material{});
  CHECK(scene.materials[scene.objects[1].material] == red());
}

TEST_CASE("equal materials are one, also when others lie between them") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 1000; ++i) {
    builder.material(i % 2 == 0 ? red() : green());
    builder.sphere({}, 1);
  }
  CHECK(scene.materials.size() == 2);
  CHECK(scene.objects[998].material == scene.objects[0].material);
  CHECK(scene.objects[999].material == scene.objects[1].material);
}

TEST_CASE("materials that differ in one number stay apart, and zeros of either sign are equal") {
  Scene scene;
  SceneBuilder builder(scene);
  for (Material material :
       {Material{.diffuse = 0.1}, Material{.specular = 0.1}, Material{.shine = 0.1}, Material{.transmittance = 0.1},
        Material{.refraction_index = 0.1}, Material{.shine = 0.0}, Material{.shine = -0.0}}) {
    builder.material(material);
  }
  CHECK(scene.materials.size() == 6);
}

TEST_CASE("a second builder goes on where the first stopped") {
  Scene scene;
  SceneBuilder(scene).material(red());
  SceneBuilder second(scene);
  second.material(green());
  second.material(red());
  second.sphere({}, 1);
  CHECK(scene.materials.size() == 2);
  CHECK(scene.objects[0].material == 0);
}

TEST_CASE("a polygon of two vertices and a patch without all its normals break an invariant") {
  Scene scene;
  SceneBuilder builder(scene);
  CHECK_THROWS_AS(builder.polygon({{0, 0, 0}, {1, 0, 0}}), InternalError);
  CHECK_THROWS_AS(builder.patch(small_triangle, {{0, 0, 1}}), InternalError);
  CHECK(scene.objects.empty());
}

TEST_CASE("a scene is replayed in file order with the material wherever it changes") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({});
  builder.material(red());
  builder.polygon(square);
  builder.material(red());
  builder.sphere({}, 1);
  builder.material(green());
  builder.patch(small_triangle, upright);
  builder.cone({}, 1, {0, 0, 1}, 1);
  Notes notes;
  replay(scene, notes);
  CHECK(notes.text == "bvlf4sfnc");
}

TEST_CASE("an empty scene is replayed as background and view") {
  Notes notes;
  replay(Scene{}, notes);
  CHECK(notes.text == "bv");
}

}  // namespace scene_scene_test
