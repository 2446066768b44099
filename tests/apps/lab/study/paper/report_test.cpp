#include "apps/lab/study/paper/report.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "apps/lab/study/paper/archive.h"
#include "apps/lab/study/paper/tables.h"
#include "tests/support/paper_results.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::paper_report_test {

using namespace apps;

namespace {

PaperReport report_of(std::uint32_t resolution) {
  const Catalogue catalogue = catalogue_of(resolution);
  const PaperResults results = as_printed(catalogue);
  return {.tables = {{"table_3", table_3(catalogue, results)}, {"losses", losses(catalogue, results)}}, .resolution = resolution};
}

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

/// Writes it and returns what is said of its pictures.
std::vector<std::string> written(const PaperReport& report, const TemporaryFolder& folder) {
  std::ostringstream messages;
  Attempts attempts(messages);
  std::vector<std::string> complaints = write_report(report, folder.path(), attempts);
  CHECK(attempts.status() == 0);
  return complaints;
}

}  // namespace

TEST_CASE("a report as a text has all tables and no pictures") {
  const std::string text = text_of(report_of(512));
  CHECK(contains(text, "pictures of 512x512 pixels"));
  CHECK(contains(text, "**Table 3"));
  CHECK(contains(text, "**Where the nodes' time goes"));
  CHECK_FALSE(contains(text, ".svg"));
  CHECK_FALSE(contains(text, "Unfinished"));
}

TEST_CASE("only a report of pictures that prices are not fitted to says so") {
  const std::string words = "fitted to pictures of 512x512 pixels: those of another size show how the study works, and no more.";
  CHECK_FALSE(contains(text_of(report_of(512)), words));
  CHECK(contains(joined_lines(text_of(report_of(511))), words));
  CHECK(contains(joined_lines(text_of(report_of(1024))), words));
}

TEST_CASE("a report in a folder has each table twice, each picture with its script, and links to the pictures") {
  const TemporaryFolder folder;
  CHECK(written(report_of(16), folder).empty());
  CHECK(folder.entry_count() == 14);
  const std::string text = file_text(folder / "report.md");
  for (const std::string name : {"table_3_seconds", "table_3", "losses"}) {
    CHECK(contains(text, "](" + name + ".svg)"));
    for (const std::string extension : {".gnuplot", ".svg"}) {
      CHECK(std::filesystem::file_size(folder / (name + extension)) > 100);
    }
  }
}

TEST_CASE("a report in a folder has the hashes of its files, and an archive with all of them") {
  const TemporaryFolder folder;
  CHECK(written(report_of(16), folder).empty());
  const std::string hashes = file_text(folder / "SHA256SUMS");
  CHECK(count(hashes, "\n") == 12);  // all but the hashes and the archive
  CHECK(run({"sh", "-c", "cd '" + folder.path().string() + "' && sha256sum --check --strict SHA256SUMS"}).status == 0);
  const Said listed = run({"python3", "-m", "zipfile", "-e", folder / "paper.zip", folder / "again"});
  REQUIRE(listed.status == 0);
  CHECK(file_text(folder / "again/paper/SHA256SUMS") == hashes);
  CHECK(file_text(folder / "again/paper/index.html") == file_text(folder / "index.html"));
  CHECK(run({"sh", "-c", "cd '" + (folder / "again/paper").string() + "' && sha256sum --check --strict SHA256SUMS"}).status == 0);
}

TEST_CASE("an archive of the same files has the same bytes, and one of none or of an empty file is one") {
  const TemporaryFolder folder;
  const std::string zip = zip_of({{"empty", ""}, {"more", std::string(100'000, 'x')}});
  CHECK(zip == zip_of({{"empty", ""}, {"more", std::string(100'000, 'x')}}));
  CHECK(zip.size() < 1'000);
  write_text(folder / "two.zip", zip);
  write_text(folder / "none.zip", zip_of({}));
  CHECK(run({"python3", "-m", "zipfile", "-t", folder / "two.zip"}).status == 0);
  CHECK(run({"python3", "-m", "zipfile", "-t", folder / "none.zip"}).status == 0);
}

TEST_CASE("a page of the report has a section for each table, with its pictures") {
  const std::string page = page_of(report_of(16));
  CHECK(contains(page, "Table 3"));
  CHECK(contains(page, "fitted to pictures of 512x512 pixels"));
  CHECK(contains(page, "Plot: Where the nodes&#39; time goes, computing apart"));
}

TEST_CASE("without gnuplot the report is complete but for the pictures, and one sentence says so") {
  const TemporaryFolder folder, empty;
  const OnlyPath path(empty.path());
  const std::vector<std::string> complaints = written(report_of(16), folder);
  REQUIRE(complaints.size() == 2);
  CHECK(contains(complaints[0], "the plots are not drawn: gnuplot cannot be started"));
  CHECK(contains(complaints[1], "the files have no hashes: sha256sum cannot be started"));
  const std::string text = file_text(folder / "report.md");
  CHECK(contains(joined_lines(text), "Note: " + complaints[0]));
  CHECK_FALSE(contains(text, ".svg)"));
  CHECK(folder.entry_count() == 10);
}

TEST_CASE("a gnuplot that fails is quoted once for each picture, and the report is complete but for the pictures") {
  const TemporaryFolder folder, bin;
  write_text(bin / "gnuplot", "#!/bin/sh\necho >&2 unknown terminal svg\nexit 1\n");
  std::filesystem::permissions(bin / "gnuplot", std::filesystem::perms::owner_all);
  const OnlyPath path(bin.path());
  const std::vector<std::string> complaints = written(report_of(16), folder);
  REQUIRE(complaints.size() == 4);  // that there are no hashes is the last
  CHECK(contains(complaints[1], "gnuplot could not draw table_3.svg, its exit status is 1: unknown terminal svg"));
  CHECK(contains(file_text(folder / "report.md"), "**Where the nodes' time goes"));
}

TEST_CASE("an unfinished report says so, and empty tables have no picture") {
  const TemporaryFolder folder;
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults none(catalogue.runs.size());
  const PaperReport report{.tables = {{"table_3", table_3(catalogue, none)}}, .resolution = 16, .is_complete = false};
  CHECK(written(report, folder).empty());
  CHECK(file_text(folder / "report.md") == text_of(report));
  CHECK(contains(text_of(report), "Unfinished: rows are missing."));
  CHECK(contains(text_of(report), "Unfinished: 24 of 24 rows are missing."));
  CHECK(contains(file_text(folder / "table_3.json"), "Unfinished: 24 of 24 rows are missing."));
  CHECK(folder.entry_count() == 6);
}

}  // namespace dmpc::tests::paper_report_test
