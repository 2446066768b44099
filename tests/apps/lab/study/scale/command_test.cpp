#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "apps/lab/study/scale/command.h"
#include "apps/lab/study/scale/measure.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::scale_command_test {

using apps::ScaleMethod;
using apps::ScaleOptions;
using apps::ScalePart;
using Words = std::vector<std::string>;

namespace {

ScaleOptions scale_options(Words words) {
  words.insert(words.begin(), {"study", "scale"});
  return apps::parse_command_line(words).options<ScaleOptions>();
}

ScaleOptions tiny_scale(const Words& more = {}) {
  Words words = {"tetra", "--sizes=1-3", "--resolution=8x8", "--size-nodes=2", "--nodes=1,3"};
  words.insert(words.end(), more.begin(), more.end());
  ScaleOptions options = scale_options(words);
  options.settings.program = DMPC_PROGRAM;
  options.table.format = apps::TableFormat::csv;
  return options;
}

std::string output_of(const ScaleOptions& options) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_scale_command(options, interrupt, output) == 0);
  return output.str().starts_with("**") ? unfolded(output.str()) : output.str();
}

bool has_word(const Words& words, const std::string& word) { return std::find(words.begin(), words.end(), word) != words.end(); }

/// A program that does what a shell's script says.
std::filesystem::path stand_in(const TemporaryFolder& folder, const std::string& script) {
  const std::filesystem::path path = folder / "stand_in";
  write_text(path, "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

/// More nodes' rows than end by themselves.
std::string endless() {
  std::string list = "--nodes=1";
  for (int more = 2; more <= 1024; ++more) {
    list += "," + std::to_string(more);
  }
  return list;
}

}  // namespace

TEST_CASE("the study of scale has a row for each scene, number of nodes and method, and their growth") {
  const std::string table = output_of(tiny_scale());
  CHECK(count(table, "\nsizes,tetra,") == 9);
  CHECK(count(table, "\nnodes,tetra,tetra-2,") == 4);
  CHECK(count(table, "\ngrowth by size,tetra,tetra-1 to tetra-3,") == 3);
  CHECK(count(table, "\ngrowth by nodes,tetra,tetra-2 on 1 to 3 nodes,") == 2);
}

TEST_CASE("the study of scale is written as text that says what it means, how busy the machine was and how all grows") {
  const std::string text = [] {
    ScaleOptions options = tiny_scale({"--repeat=2", "--parts=sizes", "--methods=quarter"});
    options.table.format = apps::TableFormat::markdown;
    return output_of(options);
  }();
  for (const char* part : {"**Study scale: 8x8 pixels, part sizes on 2 nodes**", "the median of 2", "svm quarter",
                           "- Growth, tetra-1 to tetra-3, svm quarter: ", "Load of the machine"}) {
    CAPTURE(std::string(part));
    CHECK(contains(text, part));
  }
}

TEST_CASE("a run asks for the method's strategy, cache and counters") {
  const ScaleOptions options = tiny_scale({"--cache=4KiB"});
  const auto words = [&](ScaleMethod method) {
    return apps::render_arguments({ScalePart::sizes, {.family = "tetra", .size = 2}, method, 5}, options.settings);
  };
  CHECK(has_word(words(ScaleMethod::cache), "--cache-pages=4"));
  CHECK(has_word(words(ScaleMethod::cache), "--nodes=5"));
  CHECK(has_word(words(ScaleMethod::quarter), "--count-pages"));
  CHECK(has_word(words(ScaleMethod::dataflow), "--strategy=dataflow"));
  CHECK(has_word(words(ScaleMethod::dataflow), "--resolution=8x8"));
  CHECK_FALSE(has_word(words(ScaleMethod::dataflow), "--count-pages"));
}

TEST_CASE("a run that finds no room is a row without figures, and if all are so there is no room for the study") {
  const TemporaryFolder folder;
  ScaleOptions options = tiny_scale({"--methods=dataflow", "--parts=nodes"});
  options.settings.program =
      stand_in(folder, "case \"$*\" in *--nodes=3*) echo dmpc: no room. >&2; exit 4;; esac\nexec " DMPC_PROGRAM " \"$@\"");
  CHECK(contains(output_of(options), "\nnodes,tetra,tetra-2,dataflow,3,16,,"));
  options.settings.node_counts = {3};
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_WITH_AS(apps::study_scale_command(options, interrupt, output), "no room", core::CapacityError);
  CHECK(contains(output.str(), "\nnodes,tetra,tetra-2,dataflow,3,16,,"));
}

TEST_CASE("a run that is refused for another reason than room ends the study of scale, with the rows before") {
  const TemporaryFolder folder;
  ScaleOptions options = tiny_scale({"--methods=dataflow", "--parts=nodes"});
  options.settings.program =
      stand_in(folder, "case \"$*\" in *--nodes=3*) echo dmpc: bad. >&2; exit 1;; esac\nexec " DMPC_PROGRAM " \"$@\"");
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_WITH_AS(apps::study_scale_command(options, interrupt, output), "bad", core::InputError);
  CHECK(contains(output.str(), "\nnodes,tetra,tetra-2,dataflow,1,16,"));
  CHECK_FALSE(contains(output.str(), "\nnodes,tetra,tetra-2,dataflow,3,16,"));
}

TEST_CASE("a run that the system kills is a row without figures") {
  const TemporaryFolder folder;
  ScaleOptions options = tiny_scale({"--methods=cache", "--parts=nodes"});
  options.table.format = apps::TableFormat::markdown;
  options.settings.program = stand_in(folder, "case \"$*\" in *--nodes=3*) kill -9 $$;; esac\nexec " DMPC_PROGRAM " \"$@\"");
  CHECK(contains(output_of(options), "tetra-2, svm 1MiB on 3 nodes: no figures. It was killed"));
}

TEST_CASE("the study of scale writes its table and pictures where they are asked for") {
  const TemporaryFolder folder;
  const ScaleOptions options =
      tiny_scale({"--methods=cache", "--plots=" + (folder / "plots").string(), "-o" + (folder / "table.csv").string(),
                  "--report=" + (folder / "page.html").string()});
  CHECK(output_of(options).empty());
  CHECK(file_text(folder / "table.csv") == file_text(folder / "plots" / "scale.csv"));
  for (const char* name : {"scale_tetra_seconds", "scale_tetra_memory", "scale_nodes_seconds"}) {
    CHECK(contains(file_text(folder / "plots" / (std::string(name) + ".gnuplot")), "scale.csv"));
  }
  CHECK(count(file_text(folder / "page.html"), "Plot: ") >= 3);
}

TEST_CASE("outputs of the study of scale that clash or cannot be written are refused before any run") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  const std::string plots = "--plots=" + (folder / "plots").string();
  CHECK_THROWS_AS(
      apps::study_scale_command(tiny_scale({plots, "-o" + (folder / "plots" / "scale.csv").string()}), interrupt, output),
      core::UsageError);
  CHECK_THROWS_AS(apps::study_scale_command(tiny_scale({"-o" + (folder / "no" / "a").string()}), interrupt, output),
                  core::InputError);
  CHECK(output.str().empty());
}

TEST_CASE("a program that fails by a fault of its own ends the study of scale") {
  const TemporaryFolder folder;
  ScaleOptions options = tiny_scale();
  options.settings.program = folder / "no program";
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_AS(apps::study_scale_command(options, interrupt, output), core::InputError);
  options.settings.program =
      stand_in(folder, "[ \"$1\" = --version ] && exec " DMPC_PROGRAM " --version\necho fault >&2\nexit 3");
  CHECK_THROWS_WITH_AS(apps::study_scale_command(options, interrupt, output), doctest::Contains("fault"), core::InternalError);
}

TEST_CASE("counters of a run that cannot be read are a fault of our own") {
  const TemporaryFolder folder;
  ScaleOptions options = tiny_scale();
  options.settings.program = stand_in(folder, "[ \"$1\" = --version ] && exec " DMPC_PROGRAM
                                              " --version\nfor word; do case $word in --stats=*) "
                                              "echo nonsense > \"${word#--stats=}\";; esac; done");
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_WITH_AS(apps::study_scale_command(options, interrupt, output),
                       doctest::Contains("the statistics of a render cannot be read"), core::InternalError);
}

TEST_CASE("options of the study of scale are taken") {
  const ScaleOptions options = scale_options({"mount", "rings", "--sizes=2", "--scene=mount-3", "--repeat=3", "--parts=nodes"});
  CHECK(options.settings.families == Words{"mount", "rings"});
  CHECK(options.settings.rounds == 3);
  CHECK(scale_options({}).settings.families == Words{"tetra", "mount"});
  CHECK(scale_options({"--cache=64KiB"}).settings.cache_bytes == 65536);
  CHECK(scale_options({"--nodes=8,1,3,8,1"}).settings.node_counts == std::vector<std::uint32_t>{1, 3, 8});
}

TEST_CASE("Ctrl-C ends the study of scale with status 130 and the rows finished before") {
  for (int milliseconds = 1000; milliseconds < 100'000; milliseconds *= 4) {
    ChildProcess process({DMPC_PROGRAM, "study", "scale", "tetra", "--sizes=3", "--resolution=64x64", "--format=csv", endless()});
    REQUIRE(process.blocks(SIGINT));
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    process.send(SIGINT);
    CHECK(process.status() == 130);
    if (contains(process.errors(), "the table has the rows finished before")) {
      CHECK(contains(process.output(), "\nsizes,tetra,tetra-3,"));
      return;
    }
  }
  FAIL("no row was finished");
}

}  // namespace dmpc::tests::scale_command_test
