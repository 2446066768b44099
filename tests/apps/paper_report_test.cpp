#include "apps/paper_report.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "apps/paper_tables.h"
#include "tests/support/paper_results.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

using namespace apps;

namespace {

std::vector<NamedTable> two_tables() {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults results = as_printed(catalogue);
  return {{"table_3", table_3(catalogue, results)}, {"losses", losses(catalogue, results)}};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Programs are looked for in `folder` alone.
class OnlyPath {
 public:
  explicit OnlyPath(const std::filesystem::path& folder) { ::setenv("PATH", folder.c_str(), 1); }
  ~OnlyPath() { ::setenv("PATH", before_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string before_ = std::getenv("PATH");
};

}  // namespace

TEST_CASE("a report without a folder is a text without pictures") {
  const PaperReport report = write_report(two_tables(), 16, true, std::nullopt);
  CHECK(contains(report.text, "pictures of 16x16 pixels"));
  CHECK(contains(report.text, "**Table 3"));
  CHECK_FALSE(contains(report.text, ".svg"));
  CHECK_FALSE(contains(report.text, "Interrupted"));
  CHECK(report.complaints.empty());
}

TEST_CASE("a report in a folder has each table twice, each picture with its script, and links to the pictures") {
  const TemporaryFolder folder;
  const PaperReport report = write_report(two_tables(), 16, true, folder.path());
  CHECK(report.complaints.empty());
  CHECK(folder.entry_count() == 9);
  CHECK(file_text(folder / "report.md") == report.text);
  for (const std::string name : {"table_3", "losses"}) {
    CHECK(contains(report.text, "](" + name + ".svg)"));
    for (const std::string extension : {".csv", ".json", ".gnuplot", ".svg"}) {
      CHECK(std::filesystem::file_size(folder / (name + extension)) > 100);
    }
  }
}

TEST_CASE("without gnuplot the report is complete but for the pictures, and one sentence says so") {
  const TemporaryFolder folder, empty;
  const OnlyPath path(empty.path());
  const PaperReport report = write_report(two_tables(), 16, true, folder.path());
  REQUIRE(report.complaints.size() == 1);
  CHECK(contains(report.complaints[0], "the plots are not drawn: gnuplot cannot be started"));
  CHECK(contains(report.text, "Note: " + report.complaints[0]));
  CHECK_FALSE(contains(report.text, ".svg)"));
  CHECK(folder.entry_count() == 7);
}

TEST_CASE("a gnuplot that fails is quoted once for each picture, and the report is complete but for the pictures") {
  const TemporaryFolder folder, bin;
  write_text(bin / "gnuplot", "#!/bin/sh\necho >&2 unknown terminal svg\nexit 1\n");
  std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  const OnlyPath path(bin.path());
  const PaperReport report = write_report(two_tables(), 16, true, folder.path());
  REQUIRE(report.complaints.size() == 2);
  CHECK(contains(report.complaints[0], "gnuplot could not draw table_3.svg, its exit status is 1: unknown terminal svg"));
  CHECK(file_text(folder / "report.md") == report.text);
}

TEST_CASE("an interrupted report says so, and empty tables have no picture") {
  const TemporaryFolder folder;
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults none(catalogue.runs.size());
  const PaperReport report = write_report({{"table_3", table_3(catalogue, none)}}, 16, false, folder.path());
  CHECK(contains(report.text, "Interrupted: rows are missing."));
  CHECK(contains(report.text, "Interrupted: 24 of 24 rows are missing."));
  CHECK(contains(file_text(folder / "table_3.json"), "Interrupted: 24 of 24 rows are missing."));
  CHECK(folder.entry_count() == 3);
  CHECK(report.complaints.empty());
}

}  // namespace dmpc::tests
