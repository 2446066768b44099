#include "core/scene/base_meshes.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/instances.h"
#include "tests/support/placed_meshes.h"

namespace dmpc::tests::base_meshes_test {
namespace {

using core::can_be_instanced;
using core::ObjectKind;
using core::Scene;
using core::SceneBuilder;
using core::Transform;
using core::triangles_of;
using core::Vec3d;

constexpr Transform here{};
constexpr Transform up{.shift = {0, 0, 5}};
constexpr Transform mirror{.rows = {{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
constexpr Transform stretched{.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 64}}}};

Transform with_thickness(double thickness) { return {.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, thickness}}}}; }

/// A row of so many triangles, then what is added.
Scene row_of(std::uint32_t count) {
  Scene scene;
  SceneBuilder builder(scene);
  for (std::uint32_t i = 0; i < count; ++i) {
    builder.polygon({{i * 1.0, 0, 0}, {i + 1.0, 0, 0}, {i * 1.0, 1, 0.25}});
  }
  return scene;
}

/// A long row with a patch of these normals behind it, in these places; the patch leans by a 2,048th.
Scene placed_patch(const Vec3d& normal, const std::vector<Transform>& places) {
  Scene scene = row_of(100);
  SceneBuilder(scene).patch({{0, 0, 0}, {1, 0, 0}, {0, 1, 0x1p-11}}, std::vector<Vec3d>(3, normal));
  return placed(scene, places);
}

}  // namespace

TEST_CASE("kept is what has more than 64 triangles and stands in two places or more, as it was and where its copies are") {
  const Scene scene = placed(row_of(65), {here, mirror});
  REQUIRE(scene.kept);
  REQUIRE(scene.kept->meshes.size() == 1);
  CHECK(scene.kept->meshes[0].objects.size() == 65);
  CHECK(scene.kept->meshes[0].vertices[3] == Vec3d{1, 0, 0});
  REQUIRE(scene.kept->places.size() == 2);
  CHECK(scene.kept->places[1].first == 65);
  CHECK(scene.vertices[65 * 3 + 2] == Vec3d{0, 0, 0});  // a mirror turns faces round
  CHECK_FALSE(placed(row_of(64), {here, mirror}).kept);
  CHECK_FALSE(placed(row_of(65), {here}).kept);
}

TEST_CASE("an object is of a place or of none") {
  Scene scene = row_of(67);
  expand(scene, {.meshes = {{1, 66}}, .places = {{here, 0, 66}, {up, 0, 67}}});  // one before, one between, none behind
  REQUIRE(scene.objects.size() == 1 + 65 + 1 + 65);
  CHECK(core::place_of(scene, 0) == nullptr);
  CHECK(core::place_of(scene, 1) == &scene.kept->places[0]);
  CHECK(core::place_of(scene, 65) == &scene.kept->places[0]);
  CHECK(core::place_of(scene, 66) == nullptr);
  CHECK(core::place_of(scene, 67) == &scene.kept->places[1]);
  CHECK(core::place_of(scene, 131) == &scene.kept->places[1]);
  CHECK(core::place_of(row_of(3), 0) == nullptr);
}

TEST_CASE("a place that presses a mesh flat, or makes it vanish, or takes it where doubles end, copies it") {
  CHECK(can_be_instanced(here));
  CHECK(can_be_instanced(mirror));
  CHECK(can_be_instanced(with_thickness(1e-6)));
  CHECK_FALSE(can_be_instanced(with_thickness(1e-9)));
  CHECK_FALSE(can_be_instanced(with_thickness(0)));
  CHECK_FALSE(can_be_instanced({.rows = {}}));
  CHECK_FALSE(can_be_instanced({.rows = {{{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}}}}));
  CHECK_FALSE(can_be_instanced({.rows = {{{1e-300, 0, 0}, {0, 1e-300, 0}, {0, 0, 1e-300}}}}));
  const Scene scene = placed(row_of(65), {here, with_thickness(0), mirror});
  REQUIRE(scene.kept->places.size() == 2);
  CHECK(scene.kept->places[1].first == 130);
  CHECK(scene.objects.size() == 195);
  CHECK_FALSE(placed(row_of(65), {here, with_thickness(0)}).kept);
}

TEST_CASE("what normals say is decided in the mesh, whatever a place stretches them to") {
  const Vec3d face{0, -0x1p-11, 1}, upright{0, 0, 1}, leaning{0, 0.5, 1};
  for (const Vec3d& normal : {face, upright}) {  // in the stretched place alone `upright` would be another one
    const Scene scene = placed_patch(normal, {here, stretched});
    CHECK(scene.kept->meshes[0].objects[100].kind == ObjectKind::polygon);
    CHECK(scene.objects[100].kind == ObjectKind::polygon);
    CHECK(scene.objects[201].kind == ObjectKind::polygon);
    CHECK(scene.normals.empty());
  }
  const Scene scene = placed_patch(leaning, {here, stretched});
  CHECK(scene.objects[100].kind == ObjectKind::patch);
  CHECK(scene.objects[201].kind == ObjectKind::patch);
  // What a place would press into the face's own stays, too.
  CHECK(placed_patch({0, 0.25, 1}, {here, with_thickness(1e-5)}).objects[201].kind == ObjectKind::patch);
}

TEST_CASE("polygons are divided in the mesh, and a mirror has the same triangles, turned round") {
  Scene scene = row_of(100);
  SceneBuilder(scene).polygon({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}});  // an arrow, whose only cut is between 0 and 2
  scene = placed(scene, {here, mirror});
  const std::vector<std::array<std::uint32_t, 3>> own = triangles_of(scene, 100), mirrored = triangles_of(scene, 201);
  REQUIRE(own.size() == 2);
  REQUIRE(mirrored.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& corner = scene.vertices[scene.objects[100].first + own[i][k]];
      CHECK(scene.vertices[scene.objects[201].first + mirrored[i][2 - k]] == mirror.point(corner));
    }
  }
  CHECK(triangles_of(row_of(2), 1).size() == 1);
}

}  // namespace dmpc::tests::base_meshes_test
