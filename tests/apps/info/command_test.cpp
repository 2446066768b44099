#include "apps/info/command.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/info/json.h"
#include "apps/info/record.h"
#include "apps/info/text.h"
#include "apps/main/commands.h"
#include "apps/run/instance_options.h"
#include "core/base/expect.h"
#include "tests/support/painted_square.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/text.h"

namespace dmpc::apps::info_command_test {

using tests::contains;
using Json = nlohmann::ordered_json;

namespace {

InfoOptions info(const std::string& scene, std::initializer_list<std::string> more = {}) {
  std::vector<std::string> arguments = {"info", scene};
  arguments.insert(arguments.end(), more);
  return parse_command_line(arguments).options<InfoOptions>();
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) {
    keys.push_back(key);
  }
  return keys;
}

using Keys = std::vector<std::string>;

}  // namespace

TEST_CASE("a scene is all that info needs, and then it renders nothing") {
  const InfoOptions options = info("balls-1");
  CHECK(options.picture.scene == "balls-1");
  CHECK(options.node_counts == std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 64, 128, 256});
  CHECK(options.balance.balance == dataflow::Balance::equal_size);
  CHECK(options.format == InfoFormat::text);
  CHECK(info("a", {"--nodes=8,2,8"}).node_counts == std::vector<std::uint32_t>{2, 8});
}

TEST_CASE("a system by name is asked about with its database and its pages' homes") {
  const InfoOptions machine = info("balls-1", {"--system=pixel-machine"});
  CHECK(machine.database.build.structure == core::Structure::extents);
  CHECK(machine.pages.homes == svm::PageHomes::host);
  CHECK(info("balls-1", {"--system=forest"}).database.build.page_size_bytes == 4096);
  CHECK(info("balls-1", {"--system=subsampled"}).balance.balance == dataflow::Balance::subsampled);
  CHECK(info("balls-1", {"--balance=subsampled"}).balance.balance == dataflow::Balance::subsampled);
}

TEST_CASE("with pages at home at the host a node needs less, the more of them there are") {
  const auto least = [](const std::string& homes) {
    return find_out(info("teapot-8", {"--nodes=2", "--quiet", homes})).forecast.computers.at(0).svm.least_bytes;
  };
  CHECK(least("--homes=host") < least("--homes=spread"));
}

TEST_CASE(
    "a grove that is kept is told and forecast without its copies, and one of copies as what it could "
    "be") {
  const auto found = [](const std::string& option) {
    return find_out(info("grove-2", {"--nodes=4", "--resolution=8x8", "--quiet", option}));
  };
  const InfoRecord kept = found("--instances=keep"), copies = found("--instances=expand");
  const MeshFigures& meshes = kept.scene.meshes;
  CHECK(meshes.places == copies.scene.meshes.places);
  CHECK(meshes.triangles_in_places == copies.scene.meshes.triangles_in_places);
  CHECK(meshes.triangles < meshes.triangles_in_places / 4);
  CHECK(kept.database.instances == meshes.places);
  CHECK(copies.database.instances == 0);
  CHECK(kept.database.primitives > meshes.triangles_in_places);
  CHECK(kept.forecast.computers.at(0).svm.least_bytes < copies.forecast.computers.at(0).svm.least_bytes);
  CHECK(kept.forecast.computers.at(0).dataflow.has_value());
  CHECK(kept.forecast.computers.at(0).forest.has_value());
  const auto about = [](const InfoRecord& one) {
    return static_cast<double>(one.database.bytes_otherwise(one.scene.meshes.stored_share));
  };
  CHECK(about(kept) == doctest::Approx(static_cast<double>(copies.database.bytes)).epsilon(0.3).scale(0));
  CHECK(about(copies) == doctest::Approx(static_cast<double>(kept.database.bytes)).epsilon(0.3).scale(0));
  const Json json = Json::parse(info_json(kept));
  CHECK(keys_of(json["meshes"]) ==
        Keys{"count", "places", "triangles", "placed_triangles", "instances", "instanced_bytes", "expanded_bytes"});
  CHECK(json["meshes"]["instanced_bytes"] == kept.database.bytes);
  CHECK(
      contains(info_text(kept), "; kept once in " + std::to_string(meshes.places) + " places, with a copy in each place about "));
  CHECK(contains(info_text(copies), "; a copy in each place, kept once (--instances=keep) about "));
  CHECK(info("grove-2", {"--instances=keep"}).database.build.structure == core::Structure::extents);
}

TEST_CASE("the keys of a forecast are an interface") {
  const tests::TemporaryFolder folder;
  const InfoRecord record = find_out(info(tests::write_painted_square(folder, 8), {"--nodes=2", "--resolution=8x4", "--quiet"}));
  const Json json = Json::parse(info_json(record));
  CHECK(keys_of(json) == Keys{"format",     "program",    "scene",  "objects",   "primitives", "rounding", "bounds",
                              "view",       "background", "lights", "materials", "textures",   "meshes",   "database",
                              "build_peak", "regions",    "system", "homes",     "computers",  "seconds"});
  CHECK(json["meshes"].is_null());
  CHECK(keys_of(json["objects"]) == Keys{"polygon", "patch", "textured", "sphere", "cone", "total"});
  CHECK(keys_of(json["primitives"]) == Keys{"count", "dropped", "copies"});
  CHECK(keys_of(json["rounding"]) == Keys{"moved", "moved_pixels", "collapsed", "collapsed_pixels"});
  CHECK(keys_of(json["bounds"]) == Keys{"low", "high", "extent"});
  CHECK(keys_of(json["view"]) == Keys{"camera", "from", "at", "up", "degrees", "width", "height"});
  CHECK(keys_of(json["lights"][0]) == Keys{"light", "position", "color"});
  CHECK(keys_of(json["materials"]) == Keys{"count", "mirroring", "transmitting", "textured"});
  CHECK(keys_of(json["textures"][0]) ==
        Keys{"name", "width", "height", "levels", "format", "tiles", "tile_bytes", "table_bytes"});
  CHECK(keys_of(json["database"]) == Keys{"bytes", "pages", "page_size", "bytes_per_primitive", "copies_per_primitive",
                                          "primitives_per_leaf", "cells", "macro_cells", "occupied_macro_cells", "levels_max",
                                          "records", "unused_bytes"});
  CHECK(keys_of(json["database"]["records"][0]) == Keys{"kind", "count", "bytes"});
  CHECK(keys_of(json["computers"][0]) == Keys{"nodes", "svm", "replicated", "dataflow", "dataflow_copies", "forest"});
  CHECK(keys_of(json["computers"][0]["svm"]) == Keys{"least", "least_together", "usual", "all"});
  CHECK(json["build_peak"] > 1'000'000);
  CHECK(keys_of(json["seconds"]) == Keys{"load", "build", "regions"});
}

TEST_CASE("what forest takes is told of one tree, and of nothing else") {
  CHECK(Json::parse(info_json(find_out(info("balls-1", {"--nodes=2"}))))["computers"][0]["forest"].is_null());
  const InfoRecord tree = find_out(info("balls-1", {"--nodes=2", "--structure=extents"}));
  CHECK(Json::parse(info_json(tree))["computers"][0]["forest"]["least"] > 100'000);
  CHECK(info_text(tree).find("forest, least") != std::string::npos);
}

TEST_CASE("the camera and the lights that are told give the same view and light") {
  const InfoRecord record = find_out(info("balls-1", {"--nodes=1"}));
  const Json json = Json::parse(info_json(record));
  const CameraChoice camera = parse_camera(json["view"]["camera"]);
  CHECK(camera.from == record.scene.view.from);
  CHECK(camera.at == record.scene.view.at);
  CHECK(camera.up == record.scene.view.up);
  CHECK(camera.degrees == record.scene.view.angle_degrees);
  CHECK(json["lights"].size() == 3);
  CHECK(parse_light(json["lights"][0]["light"]).color == record.scene.lights[0].color);
  CHECK(contains(info_text(record), "--camera=" + json["view"]["camera"].get<std::string>() + ", 512x512 pixels"));
}

TEST_CASE("an empty scene is told without numbers that it has not") {
  InfoRecord record;
  record.database.bytes = 1024;
  record.forecast.computers.push_back({.nodes = 2000, .svm = {.least_bytes = 3, .usual_bytes = 4, .all_bytes = 9000}});
  const Json json = Json::parse(info_json(record));
  CHECK(json["bounds"].is_null());
  CHECK(json["database"]["bytes_per_primitive"].is_null());
  CHECK(json["computers"][0]["svm"]["least_together"] == 6000);
  CHECK(json["computers"][0]["dataflow"].is_null());
  CHECK(json["computers"][0]["dataflow_copies"].is_null());
  const std::string text = info_text(record);
  CHECK(contains(text, "no objects"));
  CHECK(contains(text, "the scene is empty"));
  CHECK_FALSE(contains(text, "**Textures**"));
}

TEST_CASE("an empty scene on voxels is told as one of voxels") {
  InfoRecord record;
  record.database = figures_of(core::build_database({}, {.structure = core::Structure::voxels}), {});
  CHECK(contains(info_text(record), "1x1x1 voxels, none of them with a list"));
}

TEST_CASE("a text has a line for each matter and tables of records, textures and memory") {
  const tests::TemporaryFolder folder;
  const std::string text = info_text(find_out(info(tests::write_painted_square(folder, 8), {"--nodes=3", "--quiet"})));
  for (const char* part : {"2 textured patches\n", "\nprimitives 2\n", "extent 1 x 1 x 0\n", "\nmaterials  1, of which",
                           "are textured 1\n", "\ntextures   1\n", "\nprocess    ", "**Records**", "| texture tiles",
                           "**Textures**", "| 8x8 ", "**Memory**", "|     3 |", "--balance=equal-size"}) {
    CAPTURE(part);
    CHECK(contains(text, part));
  }
}

TEST_CASE("many lights are not all listed in a text, a name that is no text does no harm") {
  InfoRecord record;
  record.scene.name = "a\xff";
  record.scene.lights.resize(9);
  record.database.bytes = 1024;
  CHECK(tests::count(info_text(record), "--light=") == 8);
  CHECK(Json::parse(info_json(record))["lights"].size() == 9);
}

TEST_CASE("info prints to the standard output, and fails as render does") {
  const auto run = [](const std::vector<std::string>& more) {
    const tests::Said said = tests::run_dmpc(tests::together({{"info"}, more}));
    return std::to_string(said.status) + " " + said.output + said.errors;
  };
  CHECK(contains(run({"tetra-2", "--nodes=2", "--balance=subsampled", "--resolution=32x32"}), "0 scene      tetra-2: "));
  CHECK(contains(run({"nonsense"}), "1 dmpc: there is no built-in scene 'nonsense'"));
  CHECK(contains(run({"landskape-3"}), "teapot tetra tree landscape grove. Did you mean landscape-3?"));
  CHECK(contains(run({"tetra-2", "--up=z"}),
                 "2 dmpc: --scale, --up, --smooth, --missing=plain and --files=anywhere go with mesh files"));
}

#if !defined(__SANITIZE_ADDRESS__)  // which reserves more than any limit
TEST_CASE("what 256 nodes would take of a texture is told without taking it") {
  const tests::TemporaryFolder folder;
  const std::string scene = tests::write_painted_square(folder, 512);
  const tests::Said said = tests::run({"/bin/sh", "-c", "ulimit -d 400000; exec " DMPC_PROGRAM " info --nodes=256 " + scene});
  CHECK_MESSAGE(said.status == 0, said.errors);
}
#endif

}  // namespace dmpc::apps::info_command_test
