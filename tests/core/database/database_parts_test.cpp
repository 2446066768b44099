#include "core/database/database_parts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "tests/support/complaint.h"
#include "tests/support/text.h"

namespace dmpc::core::database_parts_test {

namespace {

Database small_database(Structure structure = Structure::grid) {
  return build_database(built_in_scene(parse_scene_name("mount-2")), {.structure = structure, .emitters_max = 4});
}

}  // namespace

TEST_CASE("a database put together from its parts is the same, without a copy of its records") {
  for (const Structure structure : {Structure::grid, Structure::extents, Structure::voxels}) {
    const Database database = small_database(structure);
    const Database again = DatabaseParts::of(database).assembled();
    CHECK(again.bytes().data() == database.bytes().data());
    CHECK(again.page_count() == database.page_count());
    CHECK(again.forest_page_count() == database.forest_page_count());
    CHECK(again.primitives().data() == database.primitives().data());
    CHECK(again.sources().size() == database.sources().size());
    CHECK(again.structure() == structure);
    CHECK(again.pad() == database.pad());
    CHECK(again.records().bvh_nodes == database.records().bvh_nodes);
    CHECK(again.header().region == database.header().region);
  }
}

TEST_CASE("a summary whose tables cannot be in the records is refused, with what is impossible") {
  using Change = std::function<void(DatabaseSummary&)>;
  struct Case {
    const char* words;
    Change change;
  };
  const Address beyond{0x7fffffffU};
  const Database database = small_database();
  for (const Case& one :
       {Case{"size of a page", [](auto& all) { all.page_size = 1000; }},
        {"size of a page", [](auto& all) { all.page_size = 0; }},
        {"number of pages", [](auto& all) { all.page_count = 0; }},
        {"number of pages", [](auto& all) { ++all.page_count; }},
        {"number of pages", [](auto& all) { all.page_count = std::numeric_limits<std::uint64_t>::max(); }},
        {"structure", [](auto& all) { all.structure = Structure{7}; }},
        {"structure", [](auto& all) { all.structure = Structure::voxels; }},
        {"pages of a tree", [](auto& all) { all.open_page_count = all.page_count + 1; }},
        {"cells", [](auto& all) { all.header.frame.resolution[1] = 0; }},
        {"cells", [](auto& all) { all.header.frame.resolution[2] = std::numeric_limits<std::int32_t>::max(); }},
        {"grid", [](auto& all) { all.header.frame.scale = std::numeric_limits<double>::quiet_NaN(); }},
        {"grid", [](auto& all) { all.header.frame.finest_cell = -1; }},
        {"directory", [](auto& all) { ++all.header.directory_size[0]; }},
        {"directory", [](auto& all) { all.header.region.high[0] += 1; }},
        {"directory", [&](auto& all) { all.header.directory = beyond; }},
        {"primitives", [](auto& all) { ++all.header.primitive_count; }},
        {"instances", [](auto& all) { all.header.has_instances = 1; }},
        {"table of materials", [](auto& all) { all.header.material_count = 0x3fffffffU; }},
        {"table of lights", [&](auto& all) { all.header.lights = no_address; }},
        {"table of lights", [](auto& all) { all.header.light_count = 0xffffffffU; }},
        {"table of emitters", [&](auto& all) { all.header.emitter_count = 1, all.header.emitters = beyond; }},
        {"sky", [&](auto& all) { all.header.sky.tiles = Address{0}, all.header.sky.width = all.header.sky.height = 65535; }},
        {"background", [](auto& all) { all.header.background.x = std::numeric_limits<float>::infinity(); }},
        {"pad", [](auto& all) { all.pad = -1; }}}) {
    CAPTURE(one.words);
    DatabaseParts parts = DatabaseParts::of(database);
    one.change(parts.summary);
    const std::string said = tests::complaint_of([&] { std::move(parts).assembled(); });
    CHECK_MESSAGE(tests::contains(said, one.words), said);
  }
}

}  // namespace dmpc::core::database_parts_test
