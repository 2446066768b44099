#include "core/database/database.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "apps/lab/bench/stability/mesh.h"
#include "core/base/expect.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace database_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

template <class T>
T read(const Database& database, Address address) {
  T value;
  std::memcpy(&value, database.bytes().data() + byte_offset(address), sizeof(T));
  return value;
}

/// The shading reference of a primitive's copy.
ShadingReference reference_of(const Database& database, std::uint32_t id) {
  const auto place = database.find_places()[id];
  const auto header = read<LeafHeader>(database, place.leaf);
  const std::size_t row = (value_count(header.kind) + 1) * header.count + place.lane;
  ShadingReference reference;
  std::memcpy(&reference, database.bytes().data() + byte_offset(place.leaf) + sizeof(LeafHeader) + 4 * row, sizeof(reference));
  return reference;
}

}  // namespace

TEST_CASE("degenerate primitives are dropped and counted") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.polygon({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  builder.polygon({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  builder.sphere({0, 0, 0}, 0);
  builder.cone({0, 0, 0}, 1, {0, 0, 0}, 1);
  builder.cone({0, 0, 0}, 0, {0, 0, 1}, 0);
  builder.sphere({0, 0, 0}, 1);
  const Database database = database_of(scene);
  CHECK(database.dropped() == 5);
  CHECK(database.primitives().size() == 1);
  CHECK(database.sources()[0].object == 5);
  CHECK(database.header().primitive_count == 1);
}

TEST_CASE("ids follow the file's order and name their object") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.sphere({0, 0, 0}, 1);
  builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  builder.cone({0, 0, 0}, 1, {0, 0, 1}, 1);
  const Database database = database_of(scene);
  REQUIRE(database.primitives().size() == 4);
  CHECK(database.primitives()[0].kind == PrimitiveKind::sphere);
  CHECK(database.primitives()[3].kind == PrimitiveKind::cone);
  CHECK(database.sources()[1].object == 1);
  CHECK(database.sources()[2].object == 1);
}

TEST_CASE("every primitive's place holds the primitive") {
  const Database database = database_of(scene_of(sphere_mesh(20, 30, 0)));
  CHECK(database.references() >= database.primitives().size());
  const auto places = database.find_places();
  REQUIRE(places.size() == database.primitives().size());
  for (std::uint32_t id = 0; id < places.size(); ++id) {
    const auto place = places[id];
    const auto header = read<LeafHeader>(database, place.leaf);
    const std::byte* leaf = database.bytes().data() + byte_offset(place.leaf) + sizeof(LeafHeader);
    REQUIRE(place.lane < header.count);
    std::uint32_t found = 0;
    std::memcpy(&found, leaf + std::size_t{4} * (value_count(header.kind) * header.count + place.lane), sizeof(found));
    CHECK(found == id);
    float first = 0;
    std::memcpy(&first, leaf + std::size_t{4} * place.lane, sizeof(first));
    CHECK(first == database.primitives()[id].value[0]);
  }
}

TEST_CASE("a thousand lights are found by index, and lights without a colour share one") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 1000; ++i) {
    builder.light({.position = {double(i), 0, 0}, .color = {0.25, 0.5, 0.75}, .has_color = i == 999});
  }
  builder.sphere({0, 0, 0}, 1);
  const Database database = database_of(scene);
  CHECK(database.header().light_count == 1000);
  const GridFrame& frame = database.header().frame;
  for (const std::uint32_t i : {0U, 17U, 999U}) {
    const auto light = read<LightRecord>(database, advance(database.header().lights, i * sizeof(LightRecord)));
    CHECK(light.position == Vec3f(to_local(frame, {double(i), 0, 0})));
  }
  const auto plain = read<LightRecord>(database, database.header().lights);
  CHECK(plain.intensity.x == doctest::Approx(1 / std::sqrt(1000.0)));
  const auto colored = read<LightRecord>(database, advance(database.header().lights, 999 * sizeof(LightRecord)));
  CHECK(colored.intensity == Color{0.25F, 0.5F, 0.75F});
}

TEST_CASE("materials are found by the index that a primitive carries") {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.color = {1, 0, 0}, .diffuse = 0.25});
  builder.sphere({0, 0, 0}, 1);
  builder.material({.color = {0, 1, 0}, .specular = 0.5, .shine = 7});
  builder.sphere({3, 0, 0}, 1);
  const Database database = database_of(scene);
  for (std::uint32_t id = 0; id < 2; ++id) {
    const auto reference = reference_of(database, id);
    CHECK_FALSE(reference.is_smooth());
    const auto material =
        read<MaterialRecord>(database, advance(database.header().materials, reference.material() * sizeof(MaterialRecord)));
    CHECK(material.color == (id == 0 ? Color{1, 0, 0} : Color{0, 1, 0}));
    CHECK(material.diffuse == (id == 0 ? 0.25F : 1.0F));
    CHECK(material.shine == (id == 0 ? 0.0F : 7.0F));
  }
}

TEST_CASE("pages of a size that is none are refused") {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{256}, std::size_t{1000}, std::size_t{131072}}) {
    CHECK_THROWS_AS(build_database({}, {.page_size_bytes = bytes}), InternalError);
  }
}

TEST_CASE("a database is whole pages, and every page is a view into it") {
  const Database database = build_database(scene_of(cube()), {.page_size_bytes = 512});
  CHECK(database.bytes().size() == database.page_count() * 512);
  CHECK(database.page(database.page_count() - 1).size() == 512);
  CHECK(database.page(1).data() == database.bytes().data() + 512);
}

TEST_CASE("the bytes do not depend on the number of threads") {
  for (const char* name : {"tetra-6", "rings-3", "balls-3", "teapot-6", "jacks-2"}) {
    CAPTURE(name);
    const Scene scene = built_in(name);
    const Database one = build_database(scene, {.threads = 1});
    for (const std::uint32_t threads : {2U, 8U}) {
      const Database many = build_database(scene, {.threads = threads});
      CHECK(std::equal(one.bytes().begin(), one.bytes().end(), many.bytes().begin(), many.bytes().end()));
    }
  }
}

TEST_CASE("a crowd in one cell, which threads share, gives the same bytes") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 20'000; ++i) {
    builder.sphere({i % 100 * 1e-4, i / 100 % 100 * 1e-4, i / 10'000 * 1e-4}, 1e-5);
  }
  builder.sphere({100, 100, 100}, 1);
  const Database one = build_database(scene, {.cells_per_primitive = 1e-4, .threads = 1});
  const Database many = build_database(scene, {.cells_per_primitive = 1e-4, .threads = 8});
  CHECK(std::equal(one.bytes().begin(), one.bytes().end(), many.bytes().begin(), many.bytes().end()));
}

TEST_CASE("a scene that is given away loses its objects and nothing else, and the database is the same") {
  for (const RecordOrder order : {RecordOrder::spatial, RecordOrder::scattered}) {
    Scene scene = built_in("balls-2");
    const std::size_t lights = scene.lights.size(), materials = scene.materials.size();
    const Database kept = build_database(scene, {.record_order = order});
    CHECK_FALSE(scene.objects.empty());
    const Database given = build_database(std::move(scene), {.record_order = order});
    CHECK(std::equal(kept.bytes().begin(), kept.bytes().end(), given.bytes().begin(), given.bytes().end()));
    CHECK(scene.objects.capacity() + scene.spheres.capacity() + scene.vertices.capacity() == 0);
    CHECK(scene.lights.size() == lights);
    CHECK(scene.materials.size() == materials);
  }
}

TEST_CASE("twins that are looked for after all else are found in a scene that is given away, too") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 200; ++i) {  // each twice
    const double x = 10.0 * (i / 2);
    builder.polygon({{x, 0, 0}, {x + 1, 0, 0.5}, {x, 1, 1}});
  }
  for (int i = 0; i < 42; ++i) {  // through all cells
    const double z = i / 42.0;
    builder.polygon({{0, 0, z}, {1000, 0.5, z}, {1000, 1, z + 0.01}});
  }
  for (const double x : {900.0, 900.00001}) {  // twins for floats alone
    builder.polygon({{x, 0, 0}, {x, 0, 1}, {x, 1, 0}});
  }
  const Database kept = build_database(scene, {});
  const Database given = build_database(std::move(scene), {});
  CHECK(std::ranges::equal(kept.bytes(), given.bytes()));
}

TEST_CASE("a database that forgets its records and primitives keeps its figures") {
  Database database = database_of(scene_of(sphere_mesh(20, 30, 0)));
  const std::size_t pages = database.page_count();
  const std::uint64_t references = database.references();
  database.forget_records();
  database.forget_primitives();
  CHECK(database.bytes().empty());
  CHECK(database.primitives().empty());
  CHECK(database.page_count() == pages);
  CHECK(database.references() == references);
  CHECK(database.header().primitive_count > 0);
}

TEST_CASE("BVH nodes, leaves and normals are counted by kind") {
  Scene scene;
  SceneBuilder builder(scene);
  const RecordCounts none = database_of(scene).records();
  CHECK(none.bvh_nodes + none.leaves[0] + none.leaves[1] + none.leaves[2] + none.normals == 0);
  builder.sphere({0, 0, 0}, 0.1);
  builder.cone({0.2, 0, 0}, 0.1, {0.2, 0, 0.1}, 0.1);
  builder.patch({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  const RecordCounts few = database_of(scene).records();
  CHECK(few.bvh_nodes == 1);
  CHECK(few.leaves == decltype(few.leaves){1, 1, 1});
  CHECK(few.normals == 1);
  for (int i = 0; i < 40; ++i) {
    const double z = 0.01 * (i + 1);
    builder.polygon({{0.0, 0.0, z}, {0.1, 0.0, z}, {0.0, 0.1, z}});
  }
  const Database many = database_of(scene);
  CHECK(many.records().leaves[0] >= 6);
  CHECK(many.records().normals == 1);
  Scene large = scene_of(sphere_mesh(60, 80, 0));
  const RecordCounts counts = database_of(large).records();
  CHECK(counts.bvh_nodes > 100);
  CHECK(counts.leaves[0] * leaf_lanes >= database_of(large).references());
}

TEST_CASE("the progress of a build ends with all its references, and changes nothing") {
  const Scene scene = scene_of(sphere_mesh(60, 80, 0));
  std::uint64_t last = 0, total = 0;
  const auto note = [&](std::uint64_t done, std::uint64_t all) {
    CHECK(done > last);
    last = done;
    total = all;
  };
  const Database reported = build_database(scene, {.threads = 1, .progress = note});
  CHECK(last == total);
  CHECK(total == reported.references());
  const Database plain = build_database(scene, {});
  CHECK(std::equal(reported.bytes().begin(), reported.bytes().end(), plain.bytes().begin(), plain.bytes().end()));
}

}  // namespace database_test
