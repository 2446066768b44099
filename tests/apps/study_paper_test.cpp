#include "apps/study_paper.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/expect.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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

TEST_CASE("Ctrl-C ends the study of the article with status 130 and a folder of what was finished, which says so") {
  const TemporaryFolder folder;
  std::optional<ChildProcess> started;
  const ChildProcess& process = interrupted_study(started, folder / "paper");
  CHECK(contains(process.errors(), "interrupted, the report has the rows finished before"));
  const std::string report = file_text(folder / "paper" / "report.md");
  CHECK(report == process.output());
  CHECK(contains(report, "\nInterrupted: rows are missing.\n"));
  CHECK(contains(report, "Interrupted: 32 of 32 rows are missing."));
  CHECK(contains(report, "Interrupted: claims are missing, and others may rest on fewer runs."));
  CHECK(contains(file_text(folder / "paper" / "sensitivity.json"), "Interrupted: 32 of 32 rows are missing."));
}

}  // namespace dmpc::tests
