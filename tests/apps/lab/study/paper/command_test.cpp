#include "apps/lab/study/paper/command.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::paper_command_test {

namespace {

/// `dmpc study paper` of minutes, interrupted while its runs go on: after as long as this computer takes to build the scenes.
ChildProcess& interrupted_study(std::optional<ChildProcess>& process, const std::string& folder) {
  for (int seconds = 2; seconds < 100; seconds *= 4) {
    process.emplace(std::vector<std::string>{DMPC_PROGRAM, "study", "paper", "--resolution=256", "--sensitivity", "-o", folder});
    REQUIRE(process->blocks(SIGINT));
    std::this_thread::sleep_for(std::chrono::seconds(seconds));
    process->send(SIGINT);
    CHECK(process->status() == 130);
    if (!contains(process->errors(), "nothing was written")) {
      break;
    }
  }
  return *process;
}

bool has_text(const std::filesystem::path& path) { return !file_text(path).empty(); }

/// The study's runs with one small scene in place of all: the same tables, quickly.
apps::Catalogue small_catalogue() {
  apps::Catalogue catalogue = apps::catalogue_of(8);
  for (apps::PaperRun& run : catalogue.runs) {
    run.scene = "tetra-3";
  }
  return catalogue;
}

}  // namespace

TEST_CASE("a folder that cannot be made is refused before any run") {
  const TemporaryFolder folder;
  write_text(folder / "file", "mine");
  apps::Interrupt interrupt;
  std::ostringstream output;
  const auto study = [&](const std::filesystem::path& path) {
    apps::study_paper_command({.resolution = 8, .output = path}, interrupt, output);
  };
  CHECK_THROWS_AS(study(folder / "file"), core::InputError);
  CHECK_THROWS_AS(study(folder / "file" / "more"), core::InputError);
  CHECK(file_text(folder / "file") == "mine");
  CHECK(output.str().empty());
}

TEST_CASE("a whole study writes its report, every table twice and every picture with its script" * doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  ChildProcess process({DMPC_PROGRAM, "study", "paper", "--resolution=8", "-o", folder / "paper"});
  REQUIRE(process.status() == 0);
  const bool is_drawn = process.errors().empty();
  CHECK((is_drawn || contains(process.errors(), "dmpc: the plots are not drawn: gnuplot cannot be started")));
  for (const std::string table : {"summary", "claims", "table_2", "table_3", "algorithms", "caches", "region_loads", "ray_ways",
                                  "work_items", "losses", "voxel_prices", "voxel_pairs", "law", "grid_table_3", "calibration"}) {
    CHECK(has_text(folder / "paper" / (table + ".csv")));
    CHECK(has_text(folder / "paper" / (table + ".json")));
  }
  for (const std::string plot :
       {"table_2", "table_3_seconds", "table_3", "algorithms", "caches", "misses", "traffic", "losses"}) {
    CHECK(has_text(folder / "paper" / (plot + ".gnuplot")));
    CHECK(has_text(folder / "paper" / (plot + ".svg")) == is_drawn);
  }
  for (const std::string& report : {file_text(folder / "paper" / "report.md"), process.output()}) {
    CHECK(contains(unfolded(report), "show how the study works"));
    CHECK(widest_line(report) <= 120);
    CHECK(contains(report, "| not judged |"));
    CHECK_FALSE(contains(report, "Unfinished"));
    CHECK(report.find("Claims of the text: ") < report.find("Table 3 at a glance"));
  }
  CHECK(contains(file_text(folder / "paper" / "index.html"), "Table 3 at a glance"));
  CHECK(run({"sh", "-c", "cd '" + (folder / "paper").string() + "' && sha256sum --check --strict --quiet SHA256SUMS"}).status ==
        0);
  CHECK(has_text(folder / "paper" / "paper.zip"));
}

TEST_CASE("a run that throws loses no table: what was finished is written, then the error goes on") {
  const TemporaryFolder folder;
  apps::Catalogue catalogue = small_catalogue();
  catalogue.runs.back().node_memory_bytes = 1;
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK_THROWS_AS(apps::study_catalogue(catalogue, {}, {.resolution = 8, .output = folder.path()}, interrupt, output),
                  core::InputError);
  CHECK(contains(output.str(), "\nUnfinished: rows are missing.\n"));
  CHECK(contains(output.str(), "Unfinished: claims are missing"));
  CHECK(contains(output.str(), "| Teapot "));
  CHECK(contains(file_text(folder / "report.md"), "| Teapot "));
  CHECK(has_text(folder / "table_3.csv"));
}

TEST_CASE("a file in the way in the folder loses nothing of the report") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "table_2.csv");
  apps::Interrupt interrupt;
  std::ostringstream output;
  CHECK(apps::study_catalogue(small_catalogue(), {}, {.resolution = 8, .output = folder.path()}, interrupt, output) == 1);
  CHECK(contains(output.str(), "| Teapot "));
  CHECK(contains(file_text(folder / "report.md"), "| Teapot "));
  CHECK(has_text(folder / "table_3.csv"));
  CHECK_FALSE(contains(output.str(), "Unfinished"));
}

TEST_CASE("Ctrl-C ends the study of the article with status 130 and a folder of what was finished, which says so" *
          doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  std::optional<ChildProcess> started;
  const ChildProcess& process = interrupted_study(started, folder / "paper");
  CHECK(contains(process.errors(), "interrupted, the report has the rows finished before"));
  const std::string report = file_text(folder / "paper" / "report.md");
  CHECK(process.output().starts_with("# The tables of 1994"));
  CHECK(contains(report, "\nUnfinished: rows are missing.\n"));
  CHECK(contains(report, "Unfinished: 32 of 32 rows are missing."));
  CHECK(contains(report, "Unfinished: claims are missing, and others may rest on fewer runs."));
  CHECK(contains(file_text(folder / "paper" / "sensitivity.json"), "Unfinished: 32 of 32 rows are missing."));
}

}  // namespace dmpc::tests::paper_command_test
