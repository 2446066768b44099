#include "apps/lab/bench/stability/command.h"

#include <doctest/doctest.h>

#include <sstream>

#include "apps/main/commands.h"
#include "tests/support/text.h"

namespace dmpc::tests::stability_command_test {

using apps::StabilityOptions;

namespace {

StabilityOptions stability_options(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bench", "stability"});
  return apps::parse_command_line(arguments).options<StabilityOptions>();
}

std::string output_of(const StabilityOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::bench_stability_command(options, interrupt, output) == 0);
  return output.str();
}

}  // namespace

TEST_CASE("bench stability prints a row for each kernel, and where the other tests are") {
  const std::string table = unfolded(output_of(stability_options({"--tests=R5,R6", "--rays=20"})));
  CHECK(contains(table, "| R5 sequence of cells"));
  CHECK(contains(table, "| R6 points listed, no pad"));
  CHECK(contains(table, "Failed: nothing. Worst: nothing was off."));
  CHECK(contains(table, "tests/chaos"));
  CHECK_FALSE(contains(table, "R1 "));
  CHECK(contains(table, "Tried of R5 sequence of cells"));
}

TEST_CASE("bench stability has an amount of rays, and tests by name") {
  CHECK(stability_options({}).rays == StabilityOptions::standard_rays);
  CHECK(stability_options({"--quick"}).rays == StabilityOptions::quick_rays);
  CHECK(stability_options({"--long"}).rays == 0);
  CHECK(stability_options({"--rays=7"}).rays == 7);
  CHECK(stability_options({"--tests=R1,quadrics"}).tests == std::vector<std::string>{"R1", "quadrics"});
}

}  // namespace dmpc::tests::stability_command_test
