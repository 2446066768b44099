#include "apps/lab/study/cache.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/show/page/escaped.h"
#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::study_command_test {

namespace {

using apps::StudyOptions;

StudyOptions small_study(const std::string& scene = "balls-1") {
  return {.study = {.node_count = 2, .cache_pages = {2, 8}, .machine = apps::find_machine_preset("hdr")->machine},
          .picture = {.scene = scene, .resolution = apps::Resolution{16, 16}}};
}

/// What the command writes to the standard output.
std::string output_of(const StudyOptions& options, int status = 0) {
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_command(options, interrupt, output) == status);
  return output.str().starts_with("**") ? unfolded(output.str()) : output.str();
}

/// A list of ever the same number, so long that no study ends by itself.
std::string endless(const std::string& option, const std::string& number) {
  return option + "=" + number + repeated(20000, "," + number);
}

/// `dmpc study cache` with so many rows that it does not end by itself.
std::vector<std::string> endless_study(const std::string& resolution, const std::string& samples = "--samples=1") {
  return {DMPC_PROGRAM, "study",           "cache",
          "balls-1",    "--format=csv",    "--resolution=" + resolution,
          samples,      "--machine=ipsc2", endless("--cache-pages", "1")};
}

constexpr const char* rows_are_kept = "interrupted, the table has the rows finished before";

struct Ended {
  int status = 0;
  std::string output, errors;
};

/// What becomes of a study that a signal ends when some rows are finished: after ever longer, however slow the computer is.
Ended ended_by(int signal, const std::vector<std::string>& arguments) {
  using namespace std::chrono_literals;
  for (auto wait = 500ms;; wait *= 2) {
    ChildProcess process(arguments);
    REQUIRE(process.blocks(signal));
    std::this_thread::sleep_for(wait);
    process.send(signal);
    const int status = process.status();
    const Ended ended{status, process.output(), process.errors()};
    if (contains(ended.errors, rows_are_kept) || wait > 60s) {
      return ended;
    }
  }
}

}  // namespace

TEST_CASE("a study says what it studied, its rows, and the film of all runs") {
  const std::string text = output_of(small_study());
  CHECK(contains(text, "Study cache of balls-1: 16x16 pixels, 1 sample a pixel, depth 5, convention haines, record order "));
  CHECK(count(text, "\n|") ==
        4 * count(text, "\n| cache pages |"));  // each piece of the table has its heading, a rule and two rows
  CHECK(contains(text, "Film of every run, 4 in all: "));
  CHECK_FALSE(contains(text, "Interrupted"));
}

TEST_CASE("a machine with prices for another structure than the scene's is noted") {
  StudyOptions options = small_study();
  CHECK_FALSE(contains(output_of(options), " has prices for other structures "));
  options.study.machine = apps::find_machine_preset("ipsc2-1994")->machine;
  CHECK(contains(output_of(options), "- ipsc2-1994 has prices for other structures (voxels) than grid"));
}

TEST_CASE("a study by paths says how light got about, and gives the one film of paths") {
  StudyOptions options = small_study("balls-1");
  const std::string whitted = output_of(options);
  options.picture.transport = {.kind = core::TransportKind::paths, .bounces = 1};
  options.picture.depth = options.picture.transport.depth();
  const std::string paths = output_of(options);
  CHECK(contains(paths, "1 sample a pixel, paths, 1 bounce, convention haines"));
  CHECK(contains(paths, "Film of every run, 4 in all: "));
  CHECK(whitted.substr(whitted.find("Film of")) != paths.substr(paths.find("Film of")));
}

TEST_CASE("a table goes to the file asked for and nothing to the standard output") {
  const TemporaryFolder folder;
  StudyOptions options = small_study();
  options.table.format = apps::TableFormat::csv;
  options.table.file = folder / "a.csv";
  CHECK(output_of(options).empty());
  CHECK(count(file_text(folder / "a.csv"), "\n") == 3);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("an output that cannot be written or is the scene is refused before any run") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  StudyOptions options = small_study((folder / "scene.nff").string());
  options.table.file = folder / "scene.nff";
  write_text(folder / "scene.nff", "nonsense");
  CHECK_THROWS_AS(apps::study_command(options, interrupt, output), core::UsageError);
  options.table.file = folder / "no" / "a.md";
  CHECK_THROWS_AS(apps::study_command(options, interrupt, output), core::InputError);
  CHECK(file_text(folder / "scene.nff") == "nonsense");
}

TEST_CASE("pictures of a study go to a folder that is made for them, beside the table that they are drawn from") {
  const TemporaryFolder folder;
  StudyOptions options = small_study();
  options.table.plots = folder / "new" / "plots";
  options.table.format = apps::TableFormat::csv;
  const std::string table = output_of(options);
  CHECK(file_text(*options.table.plots / "cache.csv") == table);
  for (const char* name : {"cache_efficiency.json", "cache_traffic.json"}) {
    CHECK(contains(file_text(*options.table.plots / name), "series"));
  }
  options.table.plots = folder / "new" / "plots" / "cache.csv";
  CHECK_THROWS_AS(output_of(options), core::InputError);
}

TEST_CASE("a page of a study has its table and pictures, and no place where another output goes") {
  const TemporaryFolder folder;
  StudyOptions options = small_study();
  options.table.report = folder / "page.html";
  output_of(options);
  const std::string page = file_text(folder / "page.html");
  CHECK(contains(page, "Study cache of balls-1"));
  CHECK(contains(page, "Plot: Efficiency. "));
  CHECK(contains(page, "<li>Film of every run, 4 in all"));
  options.table.file = options.table.report;
  CHECK_THROWS_AS(output_of(options), core::UsageError);
}

TEST_CASE("a table may lie in the folder of its pictures, but not in place of one of their files or of the folder") {
  const TemporaryFolder folder;
  StudyOptions options = small_study();
  options.table.plots = folder / "plots";
  options.table.file = folder / "plots" / "table.md";
  CHECK(output_of(options).empty());
  CHECK(contains(file_text(*options.table.file), "Film of every run"));
  options.table.file = folder / "plots" / "cache.csv";
  CHECK_THROWS_AS(output_of(options), core::UsageError);
  options.table.plots = options.table.file = folder / "other";
  CHECK_THROWS_AS(output_of(options), core::InputError);
}

TEST_CASE("a study draws all its pictures, there and on its page, of rows as they come") {
  const TemporaryFolder folder;
  StudyOptions options = small_study();
  options.table.plots = folder / "plots";
  options.table.report = folder / "page.html";
  output_of(options);
  for (const apps::Plot& plot : options.study.plots()) {
    CHECK(file_text(folder / "plots" / (plot.name + ".json")).size() > 100);
    CHECK(contains(file_text(folder / "page.html"), "Plot: " + apps::html::escaped(plot.title)));
  }
}

TEST_CASE("a scene that does not exist is bad input") { CHECK_THROWS_AS(output_of(small_study("nonsense-3")), core::InputError); }

TEST_CASE("Ctrl-C ends a study with status 130 and the rows finished before") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Ended study = ended_by(signal, endless_study("8x8"));
    CHECK(study.status == 130);
    CHECK(contains(study.errors, rows_are_kept));
    CHECK(contains(study.output, "cache pages,"));
    CHECK(contains(study.output, "\n1,"));
    CHECK(study.output.back() == '\n');
  }
}

TEST_CASE("Ctrl-C leaves the finished rows of runs side by side in the file, whatever its format" * doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  const std::string file = folder / "table";
  for (const auto& [format, beginning, row] :
       {std::tuple{"csv", "", "\n"}, std::tuple{"markdown", "**Study ", "\n|"}, std::tuple{"json", "{", "\"virtual_time\": "}}) {
    CAPTURE(format);
    const Ended ended = ended_by(SIGINT, {DMPC_PROGRAM, "study", "cache", "balls-1", "--machine=ipsc2", "--resolution=8x8",
                                          endless("--cache-pages", "1"), std::string("--format=") + format, "-o", file});
    CHECK(ended.status == 130);
    CHECK(contains(ended.errors, rows_are_kept));
    CHECK(file_text(file).find(beginning) == 0);
    CHECK(count(file_text(file), row) > 0);
    CHECK(folder.entry_count() == 1);
  }
}

TEST_CASE("a table that would replace the machine's file is refused") {
  const TemporaryFolder folder;
  apps::Interrupt interrupt;
  std::ostringstream output;
  StudyOptions options = small_study();
  options.table.file = options.machine_name = (folder / "mine.json").string();
  write_text(folder / "mine.json", "mine");
  CHECK_THROWS_AS(apps::study_command(options, interrupt, output), core::UsageError);
  CHECK(file_text(folder / "mine.json") == "mine");
}

TEST_CASE("Ctrl-C before the first row is finished ends a study with status 130 and no table") {
  ChildProcess process(endless_study("1024x1024", "--samples=8"));
  REQUIRE(process.blocks(SIGINT));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  process.send(SIGINT);
  CHECK(process.status() == 130);
  CHECK(contains(process.errors(), "interrupted, nothing was written"));
  CHECK(process.output().empty());
}

}  // namespace dmpc::tests::study_command_test
