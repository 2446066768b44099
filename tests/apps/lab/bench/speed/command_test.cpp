#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "apps/lab/bench/speed/ablation.h"
#include "apps/lab/bench/speed/command.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/table.h"
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

/// Four of ours over two of Embree, and bundles over packets, with and without the pager.
constexpr std::size_t kernel_pairs = 10;

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

}  // namespace

TEST_CASE("bench speed measures all its parts and holds them against what is to be reached") {
  const std::string table = output_of(tiny_speed());
  for (const char* part : {"| svm on 64 nodes, virtual ",
                           "our rays over the plain renderer's",
                           "| kernel ",
                           "| picture ",
                           "| emulation ",
                           "| build ",
                           "| load ply ",
                           "| memory ",
                           "| packets on 2 threads ",
                           "| forest on 8 nodes, pool ",
                           "| svm on 64 nodes, pool, beside 8 busy ",
                           "Writing the file, share of the command's processor time",
                           "Loading a PLY or GLB file over Assimp's reading it, wall clock (worst of 2)",
                           "| Embree robust ",
                           "| Embree fast ",
                           "| secondary",
                           "| dataflow on 64 nodes ",
                           "Kernel over Embree robust, records local",
                           "Kernel over Embree robust, through the pager",
                           "grid over Embree fast, threads: 1; closest hit",
                           "paged bundles over Embree robust packets, threads: 1; closest hit",
                           "Kernel in bundles over Embree robust, records local, primary and shadow, one thread",
                           "Whole picture on 2 nodes",
                           "64 nodes over 2",
                           "8 nodes with a cache of 10 %",
                           "Anonymous memory above",
                           "Load of the machine"}) {
    CAPTURE(std::string(part));
    CHECK(contains(table, part) == (std::string(part) != "| secondary"));  // of which the scene has none
  }
}

TEST_CASE("bench speed holds a scene of the article against its table") {
  SpeedOptions options = tiny_speed({"--parts=pages"});
  options.settings.scenes = {"mount-6-t6", "tetra-2"};
  options.has_details = true;
  const std::string table = output_of(options);
  CHECK(contains(table, "| pages | database "));
  CHECK(contains(table, "| pages | mount-6-t6 | database "));
  CHECK(contains(table, "Distinct pages a pixel over the article's (worst of 1)"));
}

TEST_CASE("bench speed prints its means first, and every comparison if asked or into a file") {
  const TemporaryFolder folder;
  SpeedOptions options = tiny_speed({"--parts=pages"});
  options.settings.scenes = {"mount-6-t6"};
  const std::string means = output_of(options);
  CHECK(contains(means, "geometric means over scenes and kinds"));
  CHECK(contains(means, "--details, or a file (-o), has all "));
  CHECK_FALSE(contains(means, "largest ratio"));
  options.table.file = folder / "speed.md";
  CHECK(output_of(options).empty());
  const std::string file = file_text(folder / "speed.md");
  CHECK(unfolded(file).find("geometric means") < unfolded(file).find("largest ratio"));
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() <= 120);
  }
}

TEST_CASE("the kernel is measured for all classes, queries and threads, all in each round") {
  SpeedOptions options = tiny_speed({"--threads=1,3"});
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_kernel(options.settings, interrupt, results);
  CHECK(results.size() == 3 * 2 * 2 * kernel_pairs);
  for (const Comparison& one : results) {
    CHECK(one.subject_figures.size() == 2);
    CHECK(one.rival_figures.size() == 2);
    CHECK(one.subject_figures.front() > 0);
  }
}

TEST_CASE("who is in several of the kernel's comparisons has one figure of a round in all") {
  SpeedOptions options = tiny_speed({"--threads=1"});
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_kernel(options.settings, interrupt, results);
  using Figures = std::vector<double>;
  for (std::size_t first = 0; first < results.size(); first += kernel_pairs) {
    std::map<std::string, std::set<Figures>> figures;
    for (std::size_t i = first; i < first + kernel_pairs; ++i) {
      figures[results[i].subject].insert(results[i].subject_figures);
      figures[results[i].rival].insert(results[i].rival_figures);
    }
    std::set<Figures> all;
    for (const auto& [contender, its] : figures) {
      CAPTURE(contender);
      CHECK(its.size() == 1);
      all.insert(its.begin(), its.end());
    }
    CHECK(figures.size() == 7);
    CHECK(all.size() == 7);
    CHECK(results[first].subject == "grid");
    CHECK(results[first + kernel_pairs - 1].subject == "paged bundles");
    CHECK(results[first + kernel_pairs - 1].rival == "Embree robust packets");
  }
}

TEST_CASE("a computer that is in several comparisons has one time in all") {
  SpeedOptions options = tiny_speed();
  apps::Interrupt interrupt;
  std::vector<Comparison> results;
  apps::measure_emulation(options.settings, interrupt, results);
  const auto of = [&](const std::string& subject) {
    return *std::find_if(results.begin(), results.end(), [&](const Comparison& one) { return one.subject == subject; });
  };
  CHECK(of("svm on 64 nodes").rival_figures == of("svm on 8 nodes").rival_figures);
  CHECK(of("svm on 8 nodes").subject_figures == of("10 %").rival_figures);
  CHECK(of("5 %").rival_figures == of("25 %").rival_figures);
  CHECK(of("5 %").subject_figures.size() == 2);
}

TEST_CASE("bench speed writes its table and plots where they are asked for") {
  const TemporaryFolder folder;
  const SpeedOptions options = tiny_speed(
      {"--parts=kernel,build", "--plots=" + (folder / "plots").string(), "--format=csv", "-o" + (folder / "table.csv").string()});
  CHECK(output_of(options).empty());
  CHECK(contains(file_text(folder / "table.csv"), "largest ratio"));
  for (const char* name : {"speed_kernel.csv", "speed_kernel.gnuplot", "speed_build.gnuplot"}) {
    CHECK(std::filesystem::exists(folder / "plots" / name));
  }
}

TEST_CASE("bench speed draws renderers whose names have commas") {
  const TemporaryFolder folder;
  output_of(tiny_speed({"--parts=plain", "--plots=" + folder.path().string()}));
  CHECK(contains(file_text(folder / "speed_plain.gnuplot"), "'svm on 64 nodes, virtual / plain on 2 threads'"));
}

TEST_CASE("bench speed writes what was measured before an error ended it") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  SpeedOptions options = tiny_speed({"--parts=kernel,memory"});
  options.settings.program = folder / "no program";
  CHECK_THROWS_AS(apps::bench_speed_command(options, interrupt, output), core::InputError);
  CHECK(contains(output.str(), "| kernel "));
  CHECK(contains(output.str(), "Ended before its time"));
}

TEST_CASE("an interrupted bench speed writes nothing before anything is measured") {
  const TemporaryFolder folder;
  SpeedOptions options = tiny_speed();
  options.table.file = folder / "table.md";
  apps::Interrupt interrupt;
  ::kill(::getpid(), SIGINT);
  while (!interrupt.requested()) {
  }
  std::ostringstream output;
  CHECK_THROWS_AS(apps::bench_speed_command(options, interrupt, output), apps::Interrupted);
  CHECK_FALSE(std::filesystem::exists(folder / "table.md"));
}

TEST_CASE("an ablation renders without each skip, without all, and with cutoffs, all in each round") {
  SpeedOptions options = tiny_speed({"--ablation", "balls-2"});
  apps::Interrupt interrupt;
  std::vector<apps::Ablation> results;
  apps::measure_ablation(options.settings, interrupt, results);
  CHECK(results.size() == 2 * (1 + core::all_skips.size() + 2 + 2));
  for (const apps::Ablation& one : results) {
    CAPTURE(one.seconds.what);
    CHECK(one.seconds.rounds() == 2);
    CHECK(one.work_ratio > 0.5);
    CHECK(one.is_exact() == !one.seconds.what.starts_with("cutoff"));
    CHECK(one.avoided.has_value() == (one.seconds.what != "all" && !one.is_control()));
    // With whom a ray of dataflow walks depends on the schedule, and so does its work, by some thousandths.
    CHECK((!one.is_control() || std::abs(one.work_ratio - 1) < 0.02));
    CHECK(one.noise > 0);
  }
  CHECK(results.front().seconds.rival_figures == results[1].seconds.rival_figures);
}

TEST_CASE("an interrupted ablation has rows of whole rounds only") {
  SpeedOptions options = tiny_speed({"--ablation"});
  options.settings.rounds = 1000;
  std::vector<apps::Ablation> results;
  for (int milliseconds = 5; results.empty(); milliseconds *= 2) {
    apps::Interrupt interrupt;
    const std::jthread killer([=] {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      ::kill(::getpid(), SIGINT);
    });
    REQUIRE_THROWS_AS(apps::measure_ablation(options.settings, interrupt, results), apps::Interrupted);
    for (const apps::Ablation& one : results) {
      CHECK(one.seconds.subject_figures.size() == results.front().seconds.rounds());
      CHECK(one.seconds.rival_figures.size() == results.front().seconds.rounds());
      CHECK(one.avoided.has_value() == (one.seconds.what != "all" && !one.is_control()));
    }
  }
  CHECK(results.front().work_ratio > 1);
}

TEST_CASE("skips that a scene needs not are worth nothing there, others are") {
  SpeedOptions options = tiny_speed({"--ablation"});
  apps::Interrupt interrupt;
  std::vector<apps::Ablation> results;
  apps::measure_ablation(options.settings, interrupt, results);
  const auto of = [&](const std::string& skip) {
    return *std::find_if(results.begin(), results.end(), [&](const apps::Ablation& one) { return one.seconds.what == skip; });
  };
  CHECK(of("all").work_ratio > 1.03);
  CHECK(of("unlit").work_ratio > 1);
  CHECK(*of("unlit").avoided > 0);
  CHECK(of("background").work_ratio > 1);
  CHECK(of("cutoff 1/255").work_ratio == 1);  // without mirrors nothing is weak
  CHECK(*of("cutoff 1/255").error == 0);
}

TEST_CASE("bench speed --ablation writes its own table and plot") {
  const TemporaryFolder folder;
  const std::string table = output_of(tiny_speed({"--ablation", "--plots=" + folder.path().string()}));
  CHECK(contains(table, "| tetra-2 | background "));
  CHECK(contains(table, "| cutoff 1/1024 | bounded "));
  CHECK(contains(table, "any-hit: "));
  CHECK(contains(table, "Load of the machine"));
  CHECK(std::filesystem::exists(folder / "speed_ablation.csv"));
}

TEST_CASE("an ablation is a part of its own") {
  CHECK(speed_options({"--ablation"}).parts == std::set{SpeedPart::ablation});
  CHECK(speed_options({"--ablation"}).settings.scenes_of(SpeedPart::ablation).size() == 6);
}

TEST_CASE("bench speed has all parts unless it is told which") {
  CHECK(speed_options({}).settings.scenes.empty());
  CHECK(speed_options({}).parts == apps::all_speed_parts());
}

TEST_CASE("a plot of a part has a bar for each pair, the mean over what was traced") {
  const auto comparison = [](const char* detail, double figure) {
    return Comparison{SpeedPart::kernel, "tetra-2", "any hit", detail, 1, "grid", "Embree fast", "", {figure}, {1}};
  };
  const std::vector<Comparison> results = {comparison("primary", 1), comparison("bounce", 4), {.part = SpeedPart::kernel}};
  const apps::Table table = plotted_table(SpeedPart::kernel, results);
  REQUIRE(table.rows().size() == 1);
  CHECK(std::get<double>(table.rows()[0][3]) == doctest::Approx(2));
  CHECK(plot_of(SpeedPart::kernel, table, "name").series.size() == 1);
  CHECK(plotted_table(SpeedPart::build, results).rows().empty());
}

}  // namespace dmpc::tests::speed_command_test
