#include "core/database/shading/emitters.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/database/database.h"
#include "core/database/extract.h"
#include "core/record/choice_node.h"
#include "core/record/records.h"
#include "core/scene/frame.h"

namespace database_emitters_test {

using namespace dmpc::core;

namespace {

Material shining(double strength) { return {.color = {1, 1, 1}, .emission = {strength, strength, strength}}; }

/// One emitter of each kind, and one primitive that is none.
Scene mixed() {
  Scene scene;
  SceneBuilder builder(scene);
  builder.material({.color = {1, 1, 1}});
  builder.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  builder.material(shining(1));
  builder.polygon({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  builder.patch({{1, 1, 1}, {2, 1, 1}, {1, 2, 1}}, {{0, 0, 1}, {0, 0, 1}, {0, 0.1, 1}});
  builder.sphere({3, 3, 2}, 0.5);
  builder.sphere({3, 3, 2}, -0.25);
  builder.cone({1, 3, 0}, 0.2, {1, 3, 1}, 0.1);
  builder.material(shining(4));
  builder.polygon({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}});
  Material holed = shining(9);
  holed.alpha = AlphaUse::blend;
  builder.material(holed);
  builder.polygon({{0, 0, 3}, {1, 0, 3}, {0, 1, 3}});
  return scene;
}

std::vector<EmitterRecord> emitters_of(const DatabaseHeader& header, std::span<const std::byte> bytes) {
  std::vector<EmitterRecord> emitters;
  const LocalRecords records(bytes);
  for (std::uint32_t i = 0; i < header.emitter_count; ++i) {
    emitters.push_back(read<EmitterRecord>(records.find(emitter_address(header, i))));
  }
  return emitters;
}

}  // namespace

TEST_CASE("triangles and balls that shine are drawn as often as their power says; cones, insides and what has holes never") {
  const Database database = build_database(mixed(), {.emitters_max = 100});
  const std::vector<EmitterRecord> emitters = emitters_of(database.header(), database.bytes());
  REQUIRE(emitters.size() == 4);
  CHECK(database.records().emitters_met == 3);
  const double sum = 0.5 + 0.5 + 3.14159265 + 2;
  for (const EmitterRecord& emitter : emitters) {
    const double power = emitter.kind == PrimitiveKind::sphere ? 3.14159265 : emitter.radiance.x == 4 ? 2 : 0.5;
    CHECK(double{emitter.chance} == doctest::Approx(power / sum).epsilon(1e-5));
    const PrimitiveValues& values = database.primitives()[emitter.primitive];
    CHECK(values.kind == emitter.kind);
    CHECK(Vec3d(emitter.corner[0]) == Vec3d(Vec3f(values.vector(0))));
  }
  const double scale = database.header().frame.scale;
  CHECK(double{database.header().emitter_density} == doctest::Approx(1 / (3 * sum * scale * scale)).epsilon(1e-5));
}

TEST_CASE("of many the most powerful are drawn, and those alone have materials that say so") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 50; ++i) {
    builder.material(shining(1 + i % 5));
    builder.polygon({{1.0 * i, 0, 0}, {1.0 * i + 0.5, 0, 0}, {1.0 * i, 0.5, 0}});
  }
  const Database all = build_database(scene, {.emitters_max = 50}), some = build_database(scene, {.emitters_max = 15});
  CHECK(all.header().emitter_count == 50);
  CHECK(all.records().emitters_met == 0);
  const std::vector<EmitterRecord> emitters = emitters_of(some.header(), some.bytes());
  REQUIRE(emitters.size() == 15);
  CHECK(some.records().emitters_met == 35);
  CHECK(std::count_if(emitters.begin(), emitters.end(), [](const EmitterRecord& emitter) { return emitter.radiance.x == 5; }) ==
        10);
  CHECK(std::count_if(emitters.begin(), emitters.end(), [](const EmitterRecord& emitter) { return emitter.radiance.x == 4; }) ==
        5);
  CHECK(some.header().drawn_materials == 5);
  CHECK(some.records().materials == 7);
}

TEST_CASE("what shines in the plane of others shows, and is drawn but for what something else that shines may cover") {
  for (const double tilt : {0.0, 0.3}) {
    CAPTURE(tilt);
    const auto at = [tilt](double x, double y) { return Vec3d{x, y, tilt * x}; };
    Scene scene;
    SceneBuilder builder(scene);
    builder.material({.color = {1, 1, 1}});
    builder.polygon({at(-1, -1), at(3, -1), at(3, 3), at(-1, 3)});
    builder.material(shining(1));
    builder.polygon({at(0, 0), at(1, 0), at(0, 1)});
    builder.polygon({at(2, 2), at(1, 2), at(2, 1)});  // beside it
    const Database database = build_database(scene, {.emitters_max = 10});
    CHECK(database.header().emitter_count == 2);
    CHECK(database.records().emitters_met == 0);
    CHECK(database.records().emitters_covered == 0);
    CHECK(database.sources()[0].object == 1);
    builder.polygon({at(0, 0), at(0.5, 0), at(0, 0.5)});
    builder.material({.transmittance = 0.5, .emission = {1, 1, 1}});
    builder.polygon({at(-0.9, -0.9), at(-0.5, -0.9), at(-0.9, -0.5)});
    const Database more = build_database(scene, {.emitters_max = 10});
    CHECK(more.header().emitter_count == 2);
    CHECK(more.records().emitters_met == 0);
    CHECK(more.records().emitters_covered == 2);
  }
}

TEST_CASE("a database for nobody who aims is, to the byte, what it was before there were emitters") {
  const Database none = build_database(mixed(), {});
  CHECK(none.header().emitter_count == 0);
  CHECK(none.header().drawn_materials == 0xffffffffU);
  Scene dark = mixed();
  for (Material& material : dark.materials) {
    material.emission = {};
  }
  const Database aiming = build_database(dark, {.emitters_max = 100}), plain = build_database(dark, {});
  CHECK(std::equal(aiming.bytes().begin(), aiming.bytes().end(), plain.bytes().begin(), plain.bytes().end()));
}

TEST_CASE("every part of a database has all emitters") {
  const Database database = build_database(mixed(), {.emitters_max = 100});
  const Region left{
      {},
      {grid_size(database.header().frame)[0] / 2, grid_size(database.header().frame)[1], grid_size(database.header().frame)[2]}};
  const DatabasePart part = extract(database, left);
  const std::vector<EmitterRecord> whole = emitters_of(database.header(), database.bytes());
  const std::vector<EmitterRecord> copies = emitters_of(part.header, part.bytes);
  REQUIRE(copies.size() == whole.size());
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    CHECK(copies[i].primitive == whole[i].primitive);
    CHECK(copies[i].chance == whole[i].chance);
  }
  const auto root = [](const DatabaseHeader& header, std::span<const std::byte> bytes) {
    return read<ChoiceNode>(LocalRecords(bytes).find(choice_address(header, 0)));
  };
  CHECK(root(part.header, part.bytes).bound == root(database.header(), database.bytes()).bound);
}

}  // namespace database_emitters_test
