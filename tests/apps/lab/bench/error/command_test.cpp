#include "apps/lab/bench/error/command.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::error_command_test {

using apps::ErrorOptions;
using apps::tessellations_of;

namespace {

using Words = std::vector<std::string>;

ErrorOptions error_options(Words arguments) {
  arguments.insert(arguments.begin(), {"bench", "error"});
  return apps::parse_command_line(arguments).options<ErrorOptions>();
}

/// Of what ends before a render: otherwise the test would become Python.
int ended_early(Words arguments) {
  arguments.insert(arguments.end(), {"--resolution=8x8", "--reference-samples=2"});
  apps::Interrupt interrupt;
  std::ostringstream output;
  return apps::bench_error_command(error_options(std::move(arguments)), interrupt, output);
}

bool is_told(const ErrorOptions& options, const std::string& word) { return std::ranges::count(options.words, word) == 1; }

}  // namespace

TEST_CASE("of pictures by paths bench error has a reference of 2^14 samples, and a smaller one if it is quick") {
  for (const auto& [words, side, width] : {std::tuple(Words{"balls-1", "--transport=paths"}, 128U, 128),
                                           {{"balls-1", "--transport=paths", "--quick"}, 32, 64},
                                           {{"balls-1", "--quick"}, 12, 192},
                                           {{"balls-1", "--quick", "--resolution=300x200", "--reference-samples=20"}, 20, 300}}) {
    const ErrorOptions options = error_options(words);
    CHECK(options.reference.samples_a_side == side);
    CHECK(options.picture.resolution->width == width);
    CHECK(is_told(options, "--reference-samples=" + std::to_string(side)));
  }
  CHECK(error_options({"teapot-12"}).reference.samples_a_side == 32);
  CHECK_FALSE(error_options({"teapot-12"}).picture.resolution);
}

TEST_CASE("Python is told each option once, with the defaults that dmpc render does not have") {
  const ErrorOptions whitted = error_options({"rings-2", "tetra-2", "--samples=4", "--light=1,2,3", "--light=4,5,6"});
  CHECK(whitted.scenes == Words{"rings-2", "tetra-2"});
  for (const char* word : {"--knobs=samples,adaptive,cutoff,depth,tessellation,arithmetic,quality", "--samples=4", "--depth=8",
                           "--transport=whitted", "--strategy=replicated", "--repeat=3", "--light=1,2,3", "--light=4,5,6"}) {
    CAPTURE(std::string(word));
    CHECK(is_told(whitted, word));
  }
  const ErrorOptions paths = error_options({"balls-1", "--transport=paths", "--bounces=3", "--repeat=2"});
  for (const char* word : {"--knobs=samples,adaptive,bounces,emitters", "--bounces=3", "--emitters=1024", "--repeat=2"}) {
    CAPTURE(std::string(word));
    CHECK(is_told(paths, word));
  }
}

TEST_CASE("knobs are those of the transport, and tessellation is asked for only of scenes that have it") {
  CHECK(error_options({"tetra-2", "--knobs=cutoff,adaptive"}).knobs == Words{"cutoff", "adaptive"});
  CHECK_NOTHROW(error_options({"rings-2", "--knobs=tessellation"}));
  for (const char* text : {"", ",", "samples,", "sample", "samples adaptive", "roulette", "bounces"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(error_options({"tetra-2", "--knobs=" + std::string(text)}), core::UsageError);
  }
}

TEST_CASE("scenes with spheres or cones are tessellated as far as a million triangles go") {
  CHECK(tessellations_of("balls-2", false) == std::vector{1, 2, 4, 8, 16});
  CHECK(tessellations_of("balls-4", false) == std::vector{1, 2});
  CHECK(tessellations_of("jacks-1", false) == std::vector{1});
  CHECK(tessellations_of("balls-2", true) == std::vector{1, 2});
  for (const char* scene : {"tetra-2", "teapot-3", "rings-2-t1", "./rings-2", "file.nff"}) {
    CAPTURE(std::string(scene));
    CHECK(tessellations_of(scene, false).empty());
  }
}

TEST_CASE("a scene that cannot be read, and what is in the way of outputs, are said before anything is rendered") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "table.md");
  std::filesystem::create_directories(folder / "plots" / "error_tetra-1.csv");
  CHECK_THROWS_AS(ended_early({"tetra-1", (folder / "no.nff").string()}), core::InputError);
  CHECK_THROWS_AS(ended_early({"tetra-1", "-o", (folder / "table.md").string()}), core::InputError);
  CHECK_THROWS_AS(ended_early({"tetra-1", "--plots=" + (folder / "plots").string()}), core::InputError);
}

TEST_CASE("no output of bench error replaces a file that a scene is read from") {
  const TemporaryFolder folder;
  const std::string obj = folder / "a.obj", mtl = folder / "a.mtl", material = "newmtl m\nKd 1 0 0\n";
  write_text(obj, "mtllib a.mtl\nusemtl m\n" + triangle_obj);
  write_text(mtl, material);
  CHECK_THROWS_AS(ended_early({obj, "-o", obj}), core::UsageError);
  CHECK_THROWS_AS(ended_early({obj, "-o", mtl}), core::UsageError);
  CHECK(file_text(mtl) == material);
}

TEST_CASE("an interrupted reference is no reference") {
  apps::Interrupt interrupt;
  interrupt.stop_once();
  std::ostringstream output;
  for (const char* transport : {"whitted", "paths"}) {
    const ErrorOptions options = error_options({"balls-1", "--resolution=8x8", "--transport=" + std::string(transport)});
    CHECK_THROWS_AS(apps::bench_error_command(options, interrupt, output), apps::Interrupted);
  }
}

}  // namespace dmpc::tests::error_command_test
