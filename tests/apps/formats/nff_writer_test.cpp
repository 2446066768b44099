#include "apps/formats/nff_writer.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include "apps/formats/nff_reader.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "tests/support/same_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace nff_writer_test {

using namespace dmpc;
using namespace dmpc::tests;

namespace {

std::string written(const core::Scene& scene) {
  std::ostringstream output;
  apps::NffWriter writer(output);
  core::replay(scene, writer);
  return output.str();
}

core::Scene read_back(const std::string& text) {
  std::istringstream input(text);
  return apps::read_nff(input, "written");
}

}  // namespace

TEST_CASE("entities are written as the SPD writes them") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  scene.background = {0.078, 0.361, 0.753};
  scene.view = {.from = {1.5, 0, -2}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45, .hither = 0.01};
  builder.light({.position = {4, 3, 2}});
  builder.light({.position = {1, 1, 1}, .color = {0.5, 1, 2}, .has_color = true});
  builder.material({.color = {1, 0.75, 0.33}, .diffuse = 0.8, .shine = 100000});
  builder.polygon({{12, 12, -0.5}, {-12, 12, -0.5}, {0, -12, -0.5}});
  builder.sphere({-0.0, 5.14416e-18, 1e6}, 0.5);
  builder.cone({0, 0, 0}, 0.15, {0, 0, 1}, 0.1005);
  builder.patch({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  CHECK(written(scene) ==
        "b 0.078 0.361 0.753\n"
        "v\nfrom 1.5 0 -2\nat 0 0 0\nup 0 0 1\nangle 45\nhither 0.01\nresolution 512 512\n"
        "l 4 3 2\nl 1 1 1 0.5 1 2\n"
        "f 1 0.75 0.33 0.8 0 100000 0 1\n"
        "p 3\n12 12 -0.5\n-12 12 -0.5\n0 -12 -0.5\n"
        "s -0 5.14416e-18 1e+06 0.5\n"
        "c 0 0 0 0.15 0 0 1 0.1005\n"
        "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n");
}

TEST_CASE("a number of more than 6 digits is written in full, so that reading gives it back") {
  core::Scene scene;
  core::SceneBuilder(scene).sphere({1.0 / 3, -1e-300, 123456789}, 4.9e-324);
  const core::Scene again = read_back(written(scene));
  CHECK(bits_of(again) == bits_of(scene));
}

TEST_CASE("a built-in scene and its written file are the same scene, bit for bit") {
  for (const char* text : {"balls-3", "gears-2", "jacks-2-t2", "jacks-2", "lattice-3", "lattice-2-t3", "mount-4", "mount-3-t3",
                           "rings-2", "rings-1-t2", "shells-2", "sombrero-1", "teapot-5", "tetra-5", "tree-5", "tree-3-t4"}) {
    CAPTURE(std::string(text));
    const core::SceneName name = core::parse_scene_name(text);
    std::ostringstream output;
    apps::NffWriter writer(output);
    core::generate_scene(name, writer);
    const core::Scene built = core::built_in_scene(name), read = read_back(output.str());
    CHECK(bits_of(read) == bits_of(built));
    CHECK(same_objects(read, built));
    CHECK(read.materials == built.materials);
  }
}

TEST_CASE("the generator's own stream is written, with a material wherever the SPD writes one") {
  std::ostringstream output;
  apps::NffWriter writer(output);
  core::generate_scene(core::parse_scene_name("lattice-1"), writer);
  const std::string text = output.str();
  CHECK(tests::count(text, "\nf ") == 8 + 12);
}

TEST_CASE("a scene is written to a file whole, by its final name only") {
  const TemporaryFolder folder;
  const std::string path = folder / "rings.nff";
  const core::SceneName name = core::parse_scene_name("rings-1");
  apps::write_nff_file(path, [&](core::SceneSink& sink) { core::generate_scene(name, sink); });
  CHECK(folder.entry_count() == 1);
  CHECK(same_objects(apps::load_scene(path), core::built_in_scene(name)));
}

TEST_CASE("a failure while writing leaves the old file as it was and nothing else") {
  const TemporaryFolder folder;
  const std::string path = folder / "old.nff";
  write_text(path, "old");
  const auto fail_halfway = [](core::SceneSink& sink) {
    sink.sphere({}, 1);
    throw std::runtime_error("halfway");
  };
  CHECK_THROWS_WITH(apps::write_nff_file(path, fail_halfway), "halfway");
  CHECK(file_text(path) == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a file that cannot be written is refused by name") {
  const TemporaryFolder folder;
  const auto nothing = [](core::SceneSink&) {};
  CHECK_THROWS_WITH_AS(apps::write_nff_file(folder / "none/a.nff", nothing), doctest::Contains("none/a.nff: cannot be written"),
                       core::InputError);
  CHECK_THROWS_AS(apps::write_nff_file(folder.path().string(), nothing), core::InputError);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a full disk is an error") {
  if (std::filesystem::exists("/dev/full")) {
    const auto produce = [](core::SceneSink& sink) { core::generate_scene(core::parse_scene_name("tetra-4"), sink); };
    CHECK_THROWS_WITH_AS(apps::write_nff_file("/dev/full", produce),
                         doctest::Contains("/dev/full: cannot be written: No space left"), core::InputError);
  }
}

}  // namespace nff_writer_test
