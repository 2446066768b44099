#include "core/database/meshes/mesh_faces.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/conversion.h"
#include "core/database/database.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placing.h"
#include "tests/support/covering_faces.h"
#include "tests/support/placed_meshes.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace dmpc::tests::mesh_faces_test {
namespace {

using apps::Random;
using core::Database;
using core::Hit;
using core::MeshFaces;
using core::Ray;
using core::Scene;
using core::Transform;
using core::Vec3d;

constexpr int rug_side = 6;
constexpr std::uint32_t rug_triangles = 2 * rug_side * rug_side;

Scene rugs(bool is_tilted) { return rug_on_floor(is_tilted, true, rug_side); }

/// Sizes of meshes in scenes, the largest first.
std::vector<Transform> many_places() {
  std::vector<Transform> places;
  for (const double size : {0.2, 0.02, 0.002, 0.0002}) {
    for (const bool is_mirrored : {false, true}) {
      const double at = static_cast<double>(places.size()) * 0.2 - 0.7;
      places.push_back(turned_place(size, {at, 0.3 - at * at, at / 3}, is_mirrored));
    }
  }
  return places;
}

/// By object, in a place's order: which others share its plane. Planes are told by the first that has them.
std::vector<std::uint32_t> groups_of(const Database& database, const core::BaseMeshInstance& place, std::size_t object_count) {
  std::vector<std::uint32_t> groups(object_count, 0);
  std::map<std::uint32_t, std::uint32_t> first_of;
  for (std::size_t id = 0; id < database.primitives().size(); ++id) {
    const std::uint32_t object = database.sources()[id].object - place.first;
    if (object < object_count && database.primitives()[id].plane() != 0) {
      groups[object] = 1 + first_of.try_emplace(database.primitives()[id].plane(), object).first->second;
    }
  }
  return groups;
}

MeshFaces faces_of(const Scene& scene) { return faces_of_meshes(scene, 0.125, core::Parallel(1)).front(); }

/// How far the corners of triangles that share a plane are from it.
double farthest_corner(const Database& database) {
  double farthest = 0;
  for (const core::PrimitiveValues& triangle : database.primitives()) {
    if (triangle.needs_plane()) {
      for (const std::size_t row : {0U, 3U, 6U}) {
        farthest = std::max(farthest, std::fabs(database.planes()[triangle.plane() - 1].height_of(triangle.vector(row))));
      }
    }
  }
  return farthest;
}

/// From both sides of a rug, from as far as it is wide and from as far as the scene is.
struct Strays {
  int rays = 0, elsewhere = 0, from_brute_force = 0;
};
Strays shoot_at_rugs(const Scene& scene, const Database& database) {
  Random random(3);
  Strays strays;
  for (const core::BaseMeshInstance& place : scene.kept->places) {
    for (std::size_t i = 0; i < scaled(200); ++i) {
      const Vec3d target = tilted(Vec3d{0.05, -0.25, 0} + Vec3d{0.9, 0.8, 0} * random.in_box(-1, 1));
      Vec3d way = random.in_box(-1, 1);
      way.z += way.z < 0 ? -0.1 : 0.1;
      const Vec3d to = place.world.point(target), near_by = place.world.point(target + tilted(way * 2.0) - tilted({}));
      const Vec3d off = near_by - to;
      const Vec3d from = i % 2 == 0 ? near_by : to + off * (0.5 / length(off));
      const auto local = [&](const Vec3d& at) { return core::to_local(database.header().frame, at); };
      const Ray ray = apps::ray_through(local(from), local(to));
      const Hit hit = apps::shoot(database, ray), brute = brute_force(database, ray);
      const std::uint32_t object = brute.found() ? database.sources()[brute.primitive].object : 0;
      const core::BaseMeshInstance* const met = core::place_of(scene, object);
      ++strays.rays;
      strays.elsewhere += met == &place && object - place.first >= rug_triangles ? 1 : 0;  // the floor below the rug
      strays.from_brute_force += apps::same_hit(hit, brute) ? 0 : 1;
    }
  }
  return strays;
}

}  // namespace

TEST_CASE("faces of a mesh share planes as in the mesh alone, however small, turned or mirrored a place is") {
  const Scene alone = in_floats(rugs(true));
  const Database mesh = core::build_database(alone, {});
  const std::vector<std::uint32_t> expected = groups_of(mesh, {}, alone.objects.size());
  REQUIRE(std::count(expected.begin(), expected.end(), 1U) == rug_triangles + 1);  // all lie in one
  Scene scene = placed(rugs(true), many_places());
  add_far_specks(scene);
  const Database database = database_of(scene);
  for (const core::BaseMeshInstance& place : scene.kept->places) {
    CHECK(groups_of(database, place, alone.objects.size()) == expected);
  }
  CHECK(database.shared_planes() == 8 * mesh.shared_planes());
}

TEST_CASE("of two faces of a mesh in one plane the first in the file shows in all places, from both sides and from afar") {
  Scene scene = placed(rugs(true), many_places());
  add_far_specks(scene);
  const Strays strays = shoot_at_rugs(scene, database_of(scene));
  CHECK(strays.rays > 0);
  CHECK(strays.elsewhere == 0);
  CHECK(strays.from_brute_force == 0);
}

TEST_CASE("a placed plane is no farther from the placed corners than boxes reach beyond them, next to local zero, too") {
  Scene scene = placed(rugs(true), many_places());
  add_far_specks(scene);
  CHECK(farthest_corner(database_of(scene)) < 0x1p-22);
  std::vector<Transform> close{turned_place(1e-4, {0.7, 0.7, 0.7}, false), turned_place(1e-4, {0.7002, 0.7, 0.7}, true)};
  Scene detail = placed(rugs(true), close);  // local zero lies there
  add_far_specks(detail);
  const Database database = database_of(detail);
  REQUIRE(length(core::to_local(database.header().frame, close[0].shift)) < 1e-3);
  CHECK(farthest_corner(database) < 0x1p-22 * 1e-3);
}

TEST_CASE("what lies level in a mesh is level where that is moved along the axes, and has a plane where it is turned") {
  const Transform beside{.rows = {{{0, 0.5, 0}, {0, 0, -0.5}, {0.5, 0, 0}}}, .shift = {0.1, 0.2, 0.3}};
  Scene scene = placed(rugs(false), {beside, turned_place(0.1, {0.5, 0.5, 0.5}, false)});
  const Database database = core::build_database(scene, {});
  const core::BaseMeshInstance& turned = scene.kept->places[1];
  for (std::size_t id = 0; id < database.primitives().size(); ++id) {
    const core::PrimitiveValues& triangle = database.primitives()[id];
    if (database.sources()[id].object >= turned.first) {
      CHECK(triangle.needs_plane());
    } else {
      CHECK(triangle.plane() == core::PrimitiveValues::level_plane);
      CHECK(triangle.value[1] == database.primitives()[0].value[1]);  // its z is this one's y
    }
  }
  CHECK(database.planes().size() == 1);
  CHECK(database.planes()[0].stored_as == core::LeafHeader::shared_plane);
}

TEST_CASE("what floats alone have at one height has a plane wherever its mesh is moved to") {
  Scene mesh = rugs(false);
  core::SceneBuilder builder(mesh);
  builder.polygon({{-1, -1, 1e-7}, {1, -1, 1e-7}, {1, 1, 1e-7}, {-1, 1, 1e-7}});
  builder.polygon({{-99, -99, -99}, {99, -99, -99}, {99, 99, 99}});  // so that the mesh's grid is as large as that
  const Scene scene = placed(mesh, {Transform{}, Transform{.shift = {5000, 0, 0}}});
  const MeshFaces faces = faces_of(scene);
  REQUIRE(faces.planes.size() == 1);
  CHECK_FALSE(faces.planes[0].is_level);
  CHECK(core::build_database(scene, {}).planes().size() == 2);
}

TEST_CASE("places that are all in one place stay, each with its triangles, where their lists are long, too") {
  Random random(2);
  Scene mesh;
  core::SceneBuilder builder(mesh);
  for (int i = 0; i < 70; ++i) {  // each from one end of the scene to the other
    builder.polygon({random.in_box(-1, -0.9), random.in_box(0.9, 1), random.in_box(0.9, 1)});
  }
  const Scene scene = placed(mesh, std::vector<Transform>(40));
  const Database database = core::build_database(scene, {.cells_per_primitive = 32});
  CHECK(database.duplicates() == 0);
  CHECK(database.primitives().size() == 40 * 70);
}

TEST_CASE("layers face the side that they face in the mesh, in a mirror, too") {
  Scene mesh = rugs(true);
  core::SceneBuilder(mesh).polygon(rectangle({-0.5, -0.5, 1e-7}, {0.5, 0.5, 1e-7}, true));  // a sheet on the rug
  const std::vector<Transform> places{turned_place(1, {}, false), turned_place(1, {8, 0, 0}, true)};
  Scene scene = mesh;
  const auto count = static_cast<std::uint32_t>(mesh.objects.size());
  core::expand(scene, {.meshes = {{0, count}}, .places = {{places[0], 0, count}, {places[1], 0, count}}});
  const Database database = database_of(scene);
  Random random(5);
  int wrong = 0;
  for (std::size_t i = 0; i < scaled(400); ++i) {
    const double side = i % 4 < 2 ? 1 : -1;
    const Vec3d target = random.in_box(-0.45, 0.45) * Vec3d{1, 1, 0}, way = random.in_box(-1, 1) * Vec3d{1, 1, 0};
    const auto local = [&](const Vec3d& at) { return core::to_local(database.header().frame, places[i % 2].point(tilted(at))); };
    const Ray ray = apps::ray_through(local(target + way + Vec3d{0, 0, side}), local(target));
    const Hit hit = apps::shoot(database, ray);
    const bool hits_sheet = hit.found() && database.sources()[hit.primitive].object % count == count - 1;
    wrong += hits_sheet == (side > 0) ? 0 : 1;
  }
  CHECK(wrong == 0);
}

TEST_CASE("of what a mesh has twice its places have one, and what a place rounds to nothing is not there, in the file's order") {
  Scene mesh = rugs(true);
  mesh.vertices.insert(mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.begin() + 3);
  mesh.objects.push_back(mesh.objects[0]);
  mesh.objects.back().first = static_cast<std::uint32_t>(mesh.vertices.size() - 3);
  core::SceneBuilder(mesh).polygon({{0, 0, 1}, {1e-5, 0, 1}, {0, 1e-5, 1}});
  Scene scene = placed(mesh, {turned_place(0.5, {0.1, 0.1, 0.1}, false), turned_place(1e-5, {0.9, 0.9, 0.9}, false)});
  const MeshFaces faces = faces_of(scene);
  CHECK(faces.duplicates == 1);
  CHECK(faces.triangles.size() == rug_triangles + 2 + 1);
  add_far_specks(scene);
  const Database database = database_of(scene);
  CHECK(database.duplicates() == 2);
  std::uint32_t last = 0;
  for (const core::PrimitiveSource& source : database.sources()) {
    CHECK(source.object >= last);
    last = source.object;
  }
  CHECK(database.primitives().size() + database.dropped() == 2 * faces.triangles.size() + 2);
}

TEST_CASE("nobody looks for faces in one plane across places, nor between a place and what is there once") {
  Scene scene = rugs(true);
  const auto count = static_cast<std::uint32_t>(scene.objects.size());
  add_floor(scene, true);
  core::expand(scene, {.meshes = {{0, count}}, .places = {{Transform{}, 0, count}, {Transform{}, 0, count}}});
  const Database database = core::build_database(scene, {});
  CHECK(database.duplicates() == 0);
  CHECK(database.primitives().size() == 2 * (rug_triangles + 2) + 2);
  CHECK(database.primitives().back().plane() == 0);
  CHECK(database.planes().size() == 2);
}

TEST_CASE("a mesh is judged the same by any number of threads") {
  Scene scene = placed(rugs(true), many_places());
  const MeshFaces one = faces_of_meshes(scene, 0.125, core::Parallel(1)).front();
  const MeshFaces many = faces_of_meshes(scene, 0.125, core::Parallel(8)).front();
  REQUIRE(one.triangles.size() == many.triangles.size());
  CHECK(std::equal(one.triangles.begin(), one.triangles.end(), many.triangles.begin(), [](const auto& a, const auto& b) {
    return a.object == b.object && a.corner == b.corner && a.plane == b.plane;
  }));
  const std::vector<MeshFaces> faces(1, one);
  const core::Conversion a = core::convert(scene, {}, core::Parallel(1), {.meshes = faces});
  const core::Conversion b = core::convert(scene, {}, core::Parallel(8), {.meshes = faces});
  CHECK(std::equal(a.primitives.begin(), a.primitives.end(), b.primitives.begin(), b.primitives.end(),
                   [](const auto& left, const auto& right) { return left.value == right.value; }));
}

}  // namespace dmpc::tests::mesh_faces_test
