#include "apps/lab/bench/precision/command.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/painted_square.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::precision_command_test {
namespace {

using apps::PrecisionOptions;

PrecisionOptions parse(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bench", "precision"});
  return apps::parse_command_line(arguments).options<PrecisionOptions>();
}

std::string output_of(const PrecisionOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::bench_precision_command(options, interrupt, output) == 0);
  return output.str().starts_with("**") ? unfolded(output.str()) : output.str();
}

TEST_CASE("bench precision takes any number of scenes") {
  CHECK(parse({}).scenes.empty());
  CHECK(parse({"tetra-3", "balls-1", "--depth=3"}).scenes == std::vector<std::string>{"tetra-3", "balls-1"});
  CHECK(parse({"--resolution=20x10"}).resolution.height == 10);
}

TEST_CASE("bench precision expects a percentage of equal pixels") {
  CHECK_FALSE(parse({}).expected);
  CHECK(parse({"--expect=98.5"}).expected == 98.5);
  CHECK(parse({"--expect=0"}).expected == 0);
}

TEST_CASE("bench precision expects of families what was measured, as it was measured, and of all else 99 percent") {
  CHECK(apps::expectation_of("balls-4").percent == 99.92);
  CHECK(apps::expectation_of("tetra-6").percent == 100);
  CHECK(apps::expectation_of("mine.nff").percent == 99);
  const auto row_of = [](const char* option) { return output_of(parse({"tetra-6", "--format=csv", option})); };
  CHECK(contains(row_of("--depth=5"), ",100,explained"));
  CHECK(contains(row_of("--depth=4"), ",99,explained"));
  CHECK(contains(row_of("--resolution=32x32"), ",99,explained"));
}

TEST_CASE("bench precision fails where fewer pixels are equal than expected, though each is explained") {
  const std::vector<std::string> line{"balls-3", "--resolution=64x64", "--depth=16"};
  const auto status_of = [&](std::vector<std::string> more, std::string& text) {
    more.insert(more.begin(), line.begin(), line.end());
    apps::Interrupt interrupt;
    std::ostringstream output;
    const int status = apps::bench_precision_command(parse(more), interrupt, output);
    text = unfolded(output.str());
    return status;
  };
  std::string text;
  CHECK(status_of({"--expect=100"}, text) == 3);
  CHECK(contains(text, "TOO FEW pixels of balls-3 have the same 8 bits"));
  CHECK(contains(text, "Failed: 1 missed expectation. Worst: "));
  CHECK(contains(text, " % of pixels equal, in balls-3."));
  CHECK(contains(text, "expected 100.00 % (by --expect)"));
  CHECK(contains(text, "| too few |"));
  CHECK(status_of({"--expect=50"}, text) == 0);
  CHECK(contains(text, "Failed: nothing."));
  CHECK(contains(text, "| explained |"));
}

TEST_CASE("a signal ends bench precision with status 130, though a scene before had too few equal pixels") {
  using namespace std::chrono_literals;
  std::vector<std::string> line{DMPC_PROGRAM, "bench",        "precision", "--resolution=64x64",
                                "--depth=16", "--expect=100", "balls-3"};
  line.insert(line.end(), 40, "balls-6");
  for (auto wait = 500ms;; wait *= 2) {  // however slow the computer is
    ChildProcess process(line);
    REQUIRE(process.blocks(SIGTERM));
    std::this_thread::sleep_for(wait);
    process.send(SIGTERM);
    CHECK(process.status() == 130);
    const std::string table = unfolded(process.output());
    if (!table.empty() || wait > 60s) {
      CHECK(contains(table, "| too few |"));
      CHECK(contains(process.errors(), "interrupted, the table has the scenes measured before"));
      break;
    }
  }
}

TEST_CASE("bench precision calls a scene warned whose pixels are off by no more than was said before") {
  const TemporaryFolder folder;
  const std::string file = (folder / "edge.nff").string();
  // Seen so narrowly that rounding moves the edge by a part of a pixel.
  write_text(file,
             "v\nfrom 0.1 0.2 6\nat -0.215 0.155 1.5\nup 0 1 0\nangle 2e-5\nhither 1\nresolution 24 24\nl 0.5 3 9\n"
             "f 0.2 0.3 0.9 1 0 0 0 0\np 3\n-0.5 -0.7 1.5\n0.6 -0.7 1.5\n0 0.8 1.5\n"
             "f 0.8 0.3 0.1 1 0 0 0 0\np 3\n-1 -1 1\n1 -1 1\n0.2 1.3 1\n");
  const std::string table = output_of(parse({file, "--resolution=24x24", "--expect=0"}));
  CHECK(contains(table, "| warned |"));
  CHECK(contains(table, "Failed: nothing."));
}

TEST_CASE("bench precision prints a row a scene and that all is explained") {
  const std::string table = output_of(parse({"tetra-3", "balls-2", "--resolution=40x30"}));
  CHECK(contains(table, "| tetra-3 |         64 |"));
  CHECK(contains(table, "| balls-2 |"));
  CHECK(contains(table, "40x30 pixels"));
  CHECK(contains(table, "Tried: 2 scenes, 2,400 pixels. Failed: nothing. Worst: "));
}

TEST_CASE("bench precision takes meshes with textures, seen and lit as one likes") {
  const TemporaryFolder folder;
  const std::string square = write_painted_square(folder, 64).string();
  const std::string table = output_of(parse({square, "--resolution=24x24", "--camera=0.5,0.4,1/0.5,0.5,0", "--light=3,4,5"}));
  CHECK(contains(table, "|          2 |"));
  CHECK(contains(table, "Failed: nothing."));
}

TEST_CASE("bench precision without a scene measures all families") {
  const std::string table = output_of(parse({"--resolution=8x8", "--format=csv"}));
  for (const char* scene : {"balls-4,", "gears-4,", "jacks-1,", "lattice-12,", "mount-6,", "rings-7,", "shells-5,", "sombrero-1,",
                            "teapot-12,", "tetra-6,", "tree-11,"}) {
    CHECK(contains(table, scene));
  }
}

TEST_CASE("bench precision writes its table to a file") {
  const TemporaryFolder folder;
  PrecisionOptions options = parse({"tetra-2", "--resolution=8x8", "--format=json"});
  options.table.file = folder / "table.json";
  CHECK(output_of(options).empty());
  CHECK(contains(file_text(folder / "table.json"), "\"unexplained\": 0"));
}

TEST_CASE("bench precision refuses a scene that is none and an output over its scene") {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_AS(apps::bench_precision_command(parse({"no-such-scene"}), interrupt, output), core::InputError);
  const TemporaryFolder folder;
  const std::string file = (folder / "a.nff").string();
  write_text(file, "");
  CHECK_THROWS_AS(apps::bench_precision_command(parse({file, "-o", file}), interrupt, output), core::UsageError);
}

}  // namespace
}  // namespace dmpc::tests::precision_command_test
