#include "apps/foreign/mesh/geometry.h"

#include <doctest/doctest.h>

#include <limits>

#include "core/base/expect.h"

namespace dmpc::apps::geometry_test {

namespace {

std::vector<FileMaterial> only(core::Material material = {}) { return {{.material = material}}; }

/// A unit square in the plane z = 0, with one normal at all corners.
core::Scene square_with(const core::Vec3d& normal, bool has_places = false) {
  PolygonMesh mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .faces = {{0, 1, 2, 3}, {4}}};
  mesh.normals.assign(4, normal);
  mesh.places.assign(has_places ? 4 : 0, {});
  core::Scene scene{.textures = {{.name = "leaf", .levels = {}}}};
  IndexedVertices vertices;
  GeometryWriter(scene, vertices, std::nullopt).add(mesh, only({.texture = has_places ? 0 : core::Material::no_texture}));
  return scene;
}

core::ObjectKind kind_of(const core::Scene& scene) { return scene.objects.front().kind; }

}  // namespace

TEST_CASE("normals that are alike over a face and not its own are kept, as leaves' cards have them") {
  const core::Scene card = square_with({0, 1, 0});
  CHECK(kind_of(card) == core::ObjectKind::patch);
  CHECK(card.normals == std::vector<core::Vec3d>(4, {0, 1, 0}));
  CHECK(square_with({0, 1, 0}, true).corners.front().normal == core::Vec3d{0, 1, 0});
  CHECK(kind_of(square_with({0.002, 0, 1})) == core::ObjectKind::patch);
}

TEST_CASE("normals that say what the face says, in whatever length, direction or digits, leave it flat") {
  CHECK(kind_of(square_with({0, 0, 1})) == core::ObjectKind::polygon);
  CHECK(kind_of(square_with({0, 0, -3})) == core::ObjectKind::polygon);
  CHECK(kind_of(square_with({0.0005, 0, 1})) == core::ObjectKind::polygon);
  CHECK(kind_of(square_with({0, 0, 0})) == core::ObjectKind::polygon);
  CHECK(square_with({0, 0, 1}, true).corners.front().normal == core::Vec3d{});
}

TEST_CASE(
    "where more faces on a texture have colours of their own than may become materials, that theirs are not shown is said") {
  for (const std::size_t count : {face_colors_max, face_colors_max + 1}) {
    PolygonMesh mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, .faces = {}};
    for (std::uint32_t i = 0; i < count; ++i) {
      mesh.faces.corners.insert(mesh.faces.corners.end(), {0, 1, 2});
      mesh.faces.ends.push_back(3 * (i + 1));
      mesh.colors.insert(mesh.colors.end(), 3, core::Vec3d{static_cast<double>(i) / 1000, 0, 0});
    }
    mesh.places.assign(mesh.colors.size(), {});
    core::Scene scene{.textures = {{.name = "leaf", .levels = {}}}};
    IndexedVertices vertices;
    GeometryWriter writer(scene, vertices, std::nullopt);
    writer.add(mesh, only({.texture = 0}));
    CHECK(writer.meshes_without_colors() == (count > face_colors_max ? 1 : 0));
  }
}

TEST_CASE("meshes give their vertices once, however many faces share them, and of many those alone that a face has") {
  core::Scene scene;
  IndexedVertices vertices;
  GeometryWriter writer(scene, vertices, std::nullopt);
  const PolygonMesh square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .faces = {{0, 1, 2, 0, 2, 3}, {3, 6}}};
  writer.add(square, only());
  CHECK(vertices.points == square.vertices);
  writer.add({.vertices = {{8, 8, 8}, {2, 0, 0}, {8, 8, 8}, {3, 0, 0}, {3, 1, 0}}, .faces = {{4, 1, 3}, {3}}}, only());
  CHECK(vertices.points.size() == 4 + 3);
  writer.add(square, only());
  CHECK(vertices.indices == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 7, 8, 9, 7, 9, 10});
  CHECK(expanded(vertices)[6] == core::Vec3d{3, 1, 0});
  CHECK(expanded(vertices)[14] == core::Vec3d{0, 1, 0});
  CHECK(scene.objects[2].first == 6);
  CHECK(scene.objects[4].first == 12);
}

TEST_CASE("runs of faces have their materials, places on their textures or none, and are smoothed each by itself") {
  PolygonMesh roof{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, .faces = {{0, 1, 2, 0, 2, 3}, {3, 6}}};
  roof.places.assign(6, {});
  roof.runs = {{.end = 1, .material = 1}, {.end = 2, .material = 0, .has_places = false}};
  const std::vector<FileMaterial> materials{{.material = {.texture = 0}}, {.material = {.color = {1, 0, 0}, .texture = 0}}};
  core::Scene scene{.textures = {{.name = "leaf", .levels = {}}}}, apart = scene, together = scene;
  IndexedVertices vertices, others, more;
  GeometryWriter writer(scene, vertices, std::nullopt);
  writer.add(roof, materials);
  CHECK(scene.objects.at(0).kind == core::ObjectKind::textured);
  CHECK(scene.materials.at(scene.objects[0].material).color == core::Vec3d{1, 0, 0});
  CHECK(scene.objects.at(1).kind == core::ObjectKind::polygon);
  CHECK(writer.unplaced() == 1);
  roof.places.clear();
  GeometryWriter(apart, others, 180).add(roof, materials);
  CHECK(kind_of(apart) == core::ObjectKind::polygon);
  roof.runs.clear();
  GeometryWriter(together, more, 180).add(roof, materials);
  CHECK(kind_of(together) == core::ObjectKind::patch);
}

TEST_CASE("a shared mesh is added once, and its places come where they are said") {
  core::Scene scene;
  IndexedVertices vertices;
  GeometryWriter writer(scene, vertices, std::nullopt);
  const PolygonMesh square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .faces = {{0, 1, 2, 0, 2, 3}, {3, 6}}};
  writer.add(square, only());
  const auto shared = writer.add_shared(square, only());
  REQUIRE(shared);
  writer.place(*shared, {.shift = {0, 0, 1}});
  writer.add(square, only());
  writer.place(*shared, {.shift = {0, 0, 2}});
  CHECK(scene.objects.size() == 6);
  CHECK(vertices.points.size() == 12);
  const core::Instances& instances = writer.instances();
  REQUIRE(instances.meshes.size() == 1);
  CHECK(instances.meshes[0].first == 2);
  CHECK(instances.meshes[0].end == 4);
  REQUIRE(instances.places.size() == 2);
  CHECK(instances.places[0].before == 4);
  CHECK(instances.places[1].before == 6);
  CHECK_FALSE(writer.add_shared({}, only()));
}

TEST_CASE("a shared mesh has an area where a place leaves it one, and counts in each of its places") {
  core::Scene scene;
  IndexedVertices vertices;
  GeometryWriter writer(scene, vertices, std::nullopt);
  const PolygonMesh upright{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, .faces = {{0, 1, 2}, {3}}};
  const auto shared = writer.add_shared(upright, only({.texture = 0}));
  CHECK_FALSE(writer.has_area());
  writer.place(*shared, {.rows = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}}});
  CHECK_FALSE(writer.has_area());
  CHECK(writer.unplaced() == 1);
  writer.place(*shared, {});
  CHECK(writer.has_area());
  CHECK(writer.unplaced() == 2);
}

TEST_CASE("a place that takes a shared mesh farther than a scene reaches is refused by the mesh's name") {
  core::Scene scene;
  IndexedVertices vertices;
  GeometryWriter writer(scene, vertices, std::nullopt);
  const auto shared =
      writer.add_shared({.name = "mesh 3", .vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, .faces = {{0, 1, 2}, {3}}}, only());
  CHECK_NOTHROW(writer.place(*shared, {.shift = {9e29, 0, 0}}));
  CHECK_THROWS_WITH_AS(writer.place(*shared, {.rows = {{{2e30, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}),
                       doctest::Contains("mesh 3: a node takes it beyond 1e30"), core::InputError);
}

TEST_CASE("a face with more corners than an object has room for is refused by its number") {
  PolygonMesh mesh{.name = "mesh 3", .vertices = {{0, 0, 0}}, .faces = {std::vector<std::uint32_t>(65'539), {3, 65'539}}};
  core::Scene scene;
  IndexedVertices vertices;
  CHECK_THROWS_WITH_AS(GeometryWriter(scene, vertices, std::nullopt).add(mesh, only()),
                       doctest::Contains("mesh 3: face 1 has too many corners"), core::InputError);
}

TEST_CASE("a scene has room for as many corners as 32 bits count, and no more") {
  CHECK_NOTHROW(SceneTotals().ask({.triangles = 1, .faces = 1, .corners = 4'294'967'294}));
  CHECK_THROWS_WITH_AS(SceneTotals().ask({.triangles = 1, .faces = 1, .corners = 4'294'967'295}),
                       doctest::Contains("there can be 4,294,967,294 corners at most"), core::CapacityError);
  CHECK_THROWS_WITH_AS(SceneTotals().ask(size_of_faces(1'431'655'765, 4'294'967'295)),
                       doctest::Contains("1,431,655,765 triangles"), core::CapacityError);
}

TEST_CASE("a scene has as much memory as it is given, and no more") {
  constexpr std::uint64_t taken = sizeof(core::Object) + 3 * sizeof(core::Vec3d);
  SceneTotals enough(2 * taken), little(2 * taken - 1);
  const auto where = [] { return std::string("a.pbrt:3:1: "); };
  for (SceneTotals* const totals : {&enough, &little}) {
    CHECK_NOTHROW(totals->add(size_of_faces(1, 3), where));
    CHECK_NOTHROW(totals->ask(size_of_faces(0, 0)));
  }
  CHECK_NOTHROW(enough.ask(size_of_faces(1, 3)));
  CHECK_NOTHROW(enough.add(size_of_faces(1, 3), where));  // what was asked for was not added
  CHECK_THROWS_WITH_AS(little.add(size_of_faces(1, 3), where),
                       doctest::Contains("a.pbrt:3:1: its 2 triangles so far take at least"), core::CapacityError);
}

TEST_CASE("a place of a base mesh takes as much as a place, and that of a small one its copy, too") {
  const GeometrySize large = size_of_faces(65, 195), small = size_of_faces(64, 192);
  const SceneTotals kept(0, core::Copies::left_out), copied(0);
  CHECK(kept.size_of_place(large).bytes == size_of_places(1).bytes);
  CHECK(kept.size_of_place(small).bytes == size_of_places(1).bytes + small.bytes);
  CHECK(copied.size_of_place(large).bytes == size_of_places(1).bytes + large.bytes);
  CHECK(size_of_places(1).bytes < 256);
  CHECK_THROWS_WITH_AS(copied.ask(size_of_places(2)), doctest::Contains("with 2 further places of meshes"), core::CapacityError);
  CHECK_THROWS_WITH_AS(copied.ask(size_of_places(2)), doctest::Contains("(--instances=keep)"), core::CapacityError);
  CHECK_THROWS_WITH_AS(kept.ask(size_of_places(2)), doctest::Contains("make the scene smaller, or divide it"),
                       core::CapacityError);
}

TEST_CASE("what vertices have makes the scene that it makes where each corner has it") {
  PolygonMesh by_vertex{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .faces = {{0, 1, 2, 0, 2, 3}, {3, 6}}};
  by_vertex.is_by_vertex = true;
  by_vertex.normals = {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
  by_vertex.places = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  PolygonMesh by_corner{.vertices = by_vertex.vertices, .faces = by_vertex.faces};
  for (const std::uint32_t vertex : by_vertex.faces.corners) {
    by_corner.normals.push_back(by_vertex.normals[vertex]);
    by_corner.places.push_back(by_vertex.places[vertex]);
  }
  by_vertex.turn(3, 6);
  by_corner.turn(3, 6);
  core::Scene first{.textures = {{.name = "leaf", .levels = {}}}}, second = first;
  IndexedVertices vertices, others;
  GeometryWriter(first, vertices, std::nullopt).add(by_vertex, only({.texture = 0}));
  GeometryWriter(second, others, std::nullopt).add(by_corner, only({.texture = 0}));
  REQUIRE(first.corners.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(first.corners[i].normal == second.corners[i].normal);
    CHECK(first.corners[i].place == second.corners[i].place);
  }
  CHECK(first.corners[3].place == std::array<float, 2>{0, 0});
}

}  // namespace dmpc::apps::geometry_test
