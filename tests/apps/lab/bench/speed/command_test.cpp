#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/command.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::speed_command_test {

using apps::Comparison;
using apps::SpeedOptions;
using apps::SpeedPart;

namespace {

using Words = std::vector<std::string>;

/// Four of ours over two of Embree.
constexpr std::size_t kernel_pairs = 8;

SpeedOptions speed_options(Words arguments) {
  arguments.insert(arguments.begin(), {"bench", "speed"});
  return apps::parse_command_line(arguments).options<SpeedOptions>();
}

SpeedOptions tiny_speed(Words more = {}) {
  more.insert(more.end(), {"tetra-2", "--resolution=16x16", "--quick", "--repeat=2"});
  SpeedOptions options = speed_options(more);
  options.settings.program = DMPC_PROGRAM;
  return options;
}

std::string output_of(const SpeedOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::bench_speed_command(options, interrupt, output) == 0);
  return output.str().starts_with("**") ? unfolded(output.str()) : output.str();
}

std::vector<Comparison> ablation_of(const Words& scenes) {
  Words words = {"--ablation"};
  words.insert(words.end(), scenes.begin(), scenes.end());
  const SpeedOptions options = tiny_speed(words);
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_ablation(options.settings, interrupt, results);
  return results;
}

}  // namespace

TEST_CASE("bench speed measures all its parts") {
  const std::string table = output_of(tiny_speed({"--all"}));
  for (const char* part : {"| svm on 64 nodes, virtual ", "| rays ", "| distance ", "| paths ", "| kernel ", "| emulation ",
                           "| build ", "| forest on 8 nodes, pool ", "| Embree robust ", "| Embree fast ", "secondary ",
                           "| dataflow on 64 nodes ", "primary ", "| replicated on 2 nodes, Embree ", "Load of the machine"}) {
    CAPTURE(std::string(part));
    CHECK(contains(table, part) == (std::string(part) != "secondary "));  // the scene has no secondary rays
  }
}

TEST_CASE("bench speed prints its means first, and every comparison into a file") {
  const TemporaryFolder folder;
  SpeedOptions options = tiny_speed({"--parts=emulation"});
  const std::string means = output_of(options);
  CHECK(contains(means, "geometric means over scenes and kinds"));
  CHECK(contains(means, "--all prints all means, a file (-o) has all 3 comparisons"));
  CHECK(contains(means, "| 5 % "));
  CHECK_FALSE(contains(means, "| 25 % "));
  CHECK_FALSE(contains(means, "largest ratio"));
  CHECK(contains(output_of(tiny_speed({"--parts=emulation", "--all"})), "| 25 % "));
  options.table.file = folder / "speed.md";
  CHECK(output_of(options).empty());
  const std::string file = file_text(folder / "speed.md");
  CHECK(unfolded(file).find("geometric means") < unfolded(file).find("largest ratio"));
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() <= 120);
  }
}

TEST_CASE(
    "the kernel is measured for all classes, queries and threads, and each contender has one figure of a round in all pairs") {
  SpeedOptions options = tiny_speed({"--threads=1,3"});
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_kernel(options.settings, interrupt, results);
  REQUIRE(results.size() == 3 * 2 * 2 * kernel_pairs);
  for (std::size_t first = 0; first < results.size(); first += kernel_pairs) {
    std::map<std::string, std::set<std::vector<double>>> figures;
    for (std::size_t i = first; i < first + kernel_pairs; ++i) {
      CHECK(results[i].figures.rounds() == 2);
      CHECK(results[i].figures.subject.front() > 0);
      figures[results[i].subject].insert(results[i].figures.subject);
      figures[results[i].baseline].insert(results[i].figures.baseline);
    }
    CHECK(figures.size() == 6);
    for (const auto& [contender, its] : figures) {
      CAPTURE(contender);
      CHECK(its.size() == 1);
    }
  }
}

TEST_CASE("caches of each size are held against one that has all pages") {
  const SpeedOptions options = tiny_speed();
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_emulation(options.settings, interrupt, results);
  const auto of = [&](const std::string& subject) {
    return *std::find_if(results.begin(), results.end(), [&](const Comparison& one) { return one.subject == subject; });
  };
  CHECK(of("5 %").figures.baseline == of("25 %").figures.baseline);
  CHECK(of("5 %").figures.subject.size() == 2);
}

TEST_CASE("bench speed writes what was measured before an error ended it") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  SpeedOptions options = tiny_speed({"--parts=emulation"});
  options.settings.scenes.push_back((folder / "no.nff").string());
  CHECK_THROWS_AS(apps::bench_speed_command(options, interrupt, output), core::InputError);
  CHECK(contains(output.str(), "| emulation "));
  CHECK(contains(output.str(), "Ended before its time"));
}

TEST_CASE("an interrupted bench speed writes nothing before anything is measured") {
  const TemporaryFolder folder;
  SpeedOptions options = tiny_speed();
  options.table.file = folder / "table.md";
  apps::Interrupt interrupt;
  interrupt.stop_once();
  std::ostringstream output;
  CHECK_THROWS_AS(apps::bench_speed_command(options, interrupt, output), apps::Interrupted);
  CHECK_FALSE(std::filesystem::exists(folder / "table.md"));
}

TEST_CASE("an ablation renders without each skip, without all, and with cutoffs, all in each round") {
  const std::vector<Comparison> results = ablation_of({"balls-2"});
  constexpr std::size_t cutoffs = 2, controls = 2;
  CHECK(results.size() == 2 * (2 * (1 + core::all_skips.size() + cutoffs + controls) + cutoffs));
  for (const Comparison& one : results) {
    CAPTURE(one.subject);
    CHECK(one.figures.rounds() == (one.what == "error" ? 1 : 2));
    // The bundle of a ray of dataflow depends on the schedule, and so does its work, by some thousandths.
    const bool is_control = one.what == "counted work" && one.subject == "the same again";
    CHECK((!is_control || std::abs(ratio_of(one.figures).median - 1) < 0.02));
  }
  CHECK(results.front().figures.baseline == results[2].figures.baseline);
}

TEST_CASE("skips that a scene needs not are worth nothing there, others are") {
  const std::vector<Comparison> results = ablation_of({});
  const auto of = [&](const std::string& what, const std::string& subject) {
    const auto found = std::find_if(results.begin(), results.end(),
                                    [&](const Comparison& one) { return one.what == what && one.subject == subject; });
    REQUIRE(found != results.end());
    return ratio_of(found->figures).median;
  };
  CHECK(of("counted work", "without all skips") > 1.03);
  CHECK(of("counted work", "without unlit") > 1);
  CHECK(of("counted work", "without background") > 1);
  CHECK(of("counted work", "without cutoff 1/255") == 1);  // without mirrors nothing is weak
  CHECK(of("error", "with cutoff 1/255") == 0);
}

TEST_CASE("bench speed --ablation has a row for each skip") {
  const TemporaryFolder folder;
  const std::string file = folder / "skips.md";
  CHECK(output_of(tiny_speed({"--ablation", "-o", file})).empty());
  const std::string table = unfolded(file_text(file));
  for (const char* const cell : {"| counted work ", "| without background ", "| the same again ", "| with it, dataflow "}) {
    CHECK_MESSAGE(contains(table, cell), cell);
  }
  CHECK(contains(table, "| ablation | tetra-2 | render "));
  CHECK(contains(table, "Load of the machine"));
}

TEST_CASE("an ablation is a part of its own") {
  CHECK(speed_options({"--ablation"}).parts == std::set{SpeedPart::ablation});
  CHECK(speed_options({"--ablation"}).settings.scenes_of(SpeedPart::ablation).size() == 6);
}

TEST_CASE("bench speed has all parts unless it is told which") {
  CHECK(speed_options({}).settings.scenes.empty());
  CHECK(speed_options({}).parts == apps::all_speed_parts());
}

TEST_CASE("what was measured comes to a row for each pair, with means over scenes, by both clocks, and of each kind") {
  const auto comparison = [](const char* scene, const char* detail, double figure) {
    return Comparison{SpeedPart::kernel, scene, "any hit", detail, 1, "grid", "Embree fast", "", {{figure}, {1}}, {{3}, {1}}};
  };
  const std::vector<Comparison> results = {comparison("a", "primary", 1),
                                           comparison("a", "bounce", 4),
                                           comparison("b", "primary", 4),
                                           comparison("b", "bounce", 16),
                                           {.part = SpeedPart::emulation}};
  const apps::Table table = apps::headline_of(results, "", true);
  REQUIRE(table.rows().size() == 1);
  const auto figure = [&](const char* column) { return apps::number_in(table, table.rows()[0], column).value(); };
  CHECK(figure("ratio") == doctest::Approx(4));
  CHECK(figure("least") == 1);
  CHECK(figure("most") == 16);
  CHECK(figure("in processor time") == doctest::Approx(3));
  CHECK(figure("of") == 4);
  CHECK(std::get<std::string>(table.rows()[0].back()) == "primary 2.000, bounce 8.000");
}

}  // namespace dmpc::tests::speed_command_test
