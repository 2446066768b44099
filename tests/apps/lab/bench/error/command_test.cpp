#include "apps/lab/bench/error/command.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/lab/bench/error/measure.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/painted_square.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::tests::error_command_test {

using apps::ErrorOptions;

namespace {

using Words = std::vector<std::string>;

ErrorOptions error_options(Words arguments) {
  arguments.insert(arguments.begin(), {"bench", "error"});
  return apps::parse_command_line(arguments).options<ErrorOptions>();
}

/// The errors of tetra-2 at 16x16 against a rough reference.
ErrorOptions tiny_error(Words more = {}) {
  more.insert(more.end(), {"tetra-2", "--resolution=16x16", "--quick", "--repeat=2"});
  return error_options(more);
}

std::string output_of(const ErrorOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::bench_error_command(options, interrupt, output) == 0);
  return output.str().starts_with("**") ? unfolded(output.str()) : output.str();
}

}  // namespace

TEST_CASE("bench error prints a row for each point, and what they say") {
  const std::string table = output_of(tiny_error());
  for (const char* part :
       {"| samples ", "| adaptive ", "| cutoff ", "| depth ", "| arithmetic ", "the reference has 12x12 samples a pixel",
        "cheapest with a deterministic RMSE", "Load of the machine"}) {
    CAPTURE(std::string(part));
    CHECK(contains(table, part));
  }
  CHECK_FALSE(contains(table, "| tessellation "));
}

TEST_CASE("bench error turns samples, adaptive samples, bounces, roulette and aims of a picture by paths, and no other knob") {
  const std::string table = output_of(error_options({"balls-1", "--transport=paths", "--bounces=2", "--sky=1", "--light-radius=3",
                                                     "--resolution=12x12", "--quick", "--reference-samples=16"}));
  CHECK(contains(table, "16 samples a pixel, paths, 2 bounces, sky 1,1,1, lights of radius 3, convention"));
  for (const char* part : {"| samples ", "| adaptive ", "| bounces ", "| roulette ", "never", "| emitters ", "none",
                           "the reference has 16x16 samples a pixel, 2 bounces", "Seconds are processor time"}) {
    CAPTURE(std::string(part));
    CHECK(contains(table, part));
  }
  for (const char* part : {"| cutoff ", "| depth ", "| arithmetic ", "| quality ", "deterministic"}) {
    CAPTURE(std::string(part));
    CHECK_FALSE(contains(table, part));
  }
}

TEST_CASE("of a scene in which nothing shines bench error says that there is nothing to aim at") {
  const std::string table = output_of(error_options({"balls-1", "--transport=paths", "--bounces=1", "--sky=1", "--quick",
                                                     "--knobs=emitters", "--resolution=8x8", "--reference-samples=4"}));
  CHECK_FALSE(contains(table, "| emitters "));
  CHECK(contains(table, "balls-1: there is no emitter for light sampling"));
}

TEST_CASE("of pictures by paths bench error has a reference of 2^14 samples") {
  CHECK(error_options({"balls-1", "--transport=paths"}).measure.reference.samples_a_side == 128);
  CHECK(error_options({"balls-1", "--transport=paths", "--quick"}).measure.reference.samples_a_side == 32);
  CHECK(error_options({"balls-1", "--transport=paths"}).measure.picture.resolution->width == 128);
  CHECK(error_options({"balls-1", "--transport=paths", "--quick"}).measure.picture.resolution->width == 64);
}

TEST_CASE("the base point of bench error has no deterministic error and float next to none") {
  const ErrorOptions options = tiny_error({"--knobs=depth,arithmetic"});
  apps::Interrupt interrupt;
  apps::SceneResult result;
  apps::measure_scene("tetra-2", options.measure, interrupt, result);
  const apps::Measurement& base = result.measurements.front();
  CHECK(base.setting == result.base);
  CHECK(base.seconds.size() == 2);
  CHECK(base.deterministic->root_mean_square == 0);
  CHECK(result.arithmetic->root_mean_square < 1e-4);
  CHECK(base.error.root_mean_square > result.arithmetic->root_mean_square);
  CHECK(base.samples == 16U * 16 * 16);
}

TEST_CASE("bench error takes meshes with textures, seen and lit as one likes, and float is next to double") {
  const TemporaryFolder folder;
  ErrorOptions options = tiny_error({"--knobs=samples,arithmetic", "--camera=0.5,0.4,1/0.5,0.5,0", "--light=3,4,5"});
  apps::Interrupt interrupt;
  apps::SceneResult result;
  apps::measure_scene(write_painted_square(folder, 64), options.measure, interrupt, result);
  CHECK(result.arithmetic->root_mean_square < 1e-4);
  const apps::Measurement& base = result.measurements.front();
  CHECK(base.error.root_mean_square > result.arithmetic->root_mean_square);
  CHECK(base.error.root_mean_square < 0.1);
}

TEST_CASE("bench error writes its table and plots where they are asked for") {
  const TemporaryFolder folder;
  CHECK(output_of(tiny_error({"--knobs=samples,depth", "--plots=" + (folder / "plots").string(), "--format=csv",
                              "-o" + (folder / "table.csv").string()}))
            .empty());
  CHECK(contains(file_text(folder / "table.csv"), "RMSE (1/255)"));
  CHECK(std::filesystem::exists(folder / "plots" / "error_tetra-2_knobs.json"));
}

TEST_CASE("bench error writes what was measured before an error ended it") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  ErrorOptions options = tiny_error({"--knobs=depth"});
  options.scenes.push_back((folder / "no.nff").string());
  CHECK_THROWS_AS(apps::bench_error_command(options, interrupt, output), core::InputError);
  CHECK(contains(output.str(), "| tetra-2 | depth "));
  CHECK(contains(output.str(), "Ended before its time"));
}

TEST_CASE("an interrupted bench error writes nothing before anything is measured") {
  const TemporaryFolder folder;
  ErrorOptions options = tiny_error();
  options.table.file = folder / "table.md";
  apps::Interrupt interrupt;
  interrupt.stop_once();
  std::ostringstream output;
  CHECK_THROWS_AS(apps::bench_error_command(options, interrupt, output), apps::Interrupted);
  CHECK_FALSE(std::filesystem::exists(folder / "table.md"));
}

TEST_CASE("bench error takes several scenes, and knobs that they have") {
  CHECK(error_options({"rings-2", "tetra-2"}).scenes == Words{"rings-2", "tetra-2"});
  CHECK_NOTHROW(error_options({"rings-2", "--knobs=tessellation"}));
}

TEST_CASE("a quick bench error is small, but for what is said otherwise") {
  const ErrorOptions quick = error_options({"teapot-12", "--quick"});
  CHECK(quick.measure.picture.resolution->width == 192);
  CHECK(quick.measure.rounds == 3);
  CHECK(quick.measure.reference.samples_a_side == 12);
  const ErrorOptions own =
      error_options({"teapot-12", "--quick", "--resolution=300x200", "--repeat=2", "--reference-samples=20"});
  CHECK(own.measure.picture.resolution->width == 300);
  CHECK(own.measure.rounds == 2);
  CHECK(own.measure.reference.samples_a_side == 20);
  CHECK_FALSE(error_options({"teapot-12"}).measure.picture.resolution);
}

}  // namespace dmpc::tests::error_command_test
