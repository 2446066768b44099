#include "apps/lab/bench/precision/command.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "core/base/expect.h"
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
  CHECK_THROWS_AS(parse({"--resolution=20"}), core::UsageError);
  CHECK_THROWS_AS(parse({"--depth=0"}), core::UsageError);
}

TEST_CASE("bench precision prints a row a scene and that all is explained") {
  const std::string table = output_of(parse({"tetra-3", "balls-2", "--resolution=40x30"}));
  CHECK(contains(table, "| tetra-3 |         64 |"));
  CHECK(contains(table, "| balls-2 |"));
  CHECK(contains(table, "40x30 pixels"));
  CHECK(contains(table, "Every pixel is explained."));
}

TEST_CASE("bench precision takes meshes with textures, seen and lit as one likes") {
  const TemporaryFolder folder;
  const std::string square = write_painted_square(folder, 64).string();
  const std::string table = output_of(parse({square, "--resolution=24x24", "--camera=0.5,0.4,1/0.5,0.5,0", "--light=3,4,5"}));
  CHECK(contains(table, "|          2 |"));
  CHECK(contains(table, "Every pixel is explained."));
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
