#include "apps/frontend/table/table_files.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/unwritable.h"

namespace dmpc::tests::table_files_test {

using apps::Attempts;
using apps::TableFiles;
using apps::TableOutput;

namespace {

apps::PlottedTable plotted_times() {
  apps::Table table("Times", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  return {table, "times.csv", {{.name = "one", .title = "Times", .place = "nodes", .series = {{"ours", "time"}}}}};
}

apps::TableResult whole_result() {
  return {.text = "the table\n",
          .page = [] { return std::string("the page"); },
          .plotted = [] { return std::vector<apps::PlottedTable>{plotted_times()}; }};
}

TableOutput all_in(const TemporaryFolder& folder) {
  return {.file = folder / "table.md", .report = folder / "page.html", .plots = folder / "plots"};
}

const std::vector<apps::PlottedNames> plotted_names = {{"times.csv", {"one"}}};

/// What is said of what could not be written.
struct Written {
  int status = 0;
  std::string output, messages;
};

Written written(const TableOutput& asked, const apps::TableResult& what = whole_result()) {
  std::ostringstream output, messages, complaints;
  Attempts attempts(messages);
  TableFiles(asked, plotted_names).write(what, output, complaints, attempts);
  return {attempts.status(), output.str(), messages.str()};
}

}  // namespace

TEST_CASE("a table, its page and its pictures go where they are asked for") {
  const TemporaryFolder folder;
  const Written all = written(all_in(folder));
  CHECK(all.status == 0);
  CHECK(all.output.empty());
  CHECK(file_text(folder / "table.md") == "the table\n");
  CHECK(file_text(folder / "page.html") == "the page");
  CHECK(file_text(folder / "plots" / "times.csv") == "nodes,time (s)\n1,8\n");
  CHECK(contains(file_text(folder / "plots" / "one.json"), "series"));
  CHECK(written({}).output == "the table\n");
}

TEST_CASE("each output that cannot be written is said, and all others are there but for pictures without data") {
  for (const std::string bad : {"table.md", "page.html", "plots/times.csv", "plots/one.json"}) {
    CAPTURE(bad);
    const TemporaryFolder folder;
    make_unwritable(folder / bad);
    const Written all = written(all_in(folder));
    CHECK(all.status == 1);
    CHECK(count(all.messages, "dmpc: ") == 1);
    CHECK(contains(all.messages, bad));
    for (const std::string good : {"table.md", "page.html", "plots/times.csv", "plots/one.json"}) {
      const bool needs_bad = good == bad || (bad == "plots/times.csv" && good == "plots/one.json");
      CHECK(file_text(folder / good).empty() == needs_bad);
    }
  }
}

TEST_CASE("a page or a picture that fails by itself keeps the table and the other") {
  const TemporaryFolder folder;
  apps::TableResult what = whole_result();
  what.page = []() -> std::string { throw core::InputError("no page"); };
  CHECK(contains(written(all_in(folder), what).messages, "no page"));
  CHECK(file_text(folder / "table.md") == "the table\n");
  CHECK_FALSE(std::filesystem::exists(folder / "page.html"));
  CHECK(std::filesystem::exists(folder / "plots" / "times.csv"));
}

TEST_CASE("what is in the way of an output is found before anything is done") {
  for (const std::string bad : {"table.md", "page.html", "plots/times.csv", "plots/one.json", "plots/one.svg"}) {
    CAPTURE(bad);
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / bad);
    CHECK_THROWS_WITH_AS(TableFiles(all_in(folder), plotted_names), doctest::Contains("this is a folder"), core::InputError);
    CHECK(folder.entry_count() <= 2);
  }
}

TEST_CASE("no output of a table falls on an input, on another output, or on another file of the command") {
  const TemporaryFolder folder;
  write_text(folder / "scene.nff", "mine");
  TableOutput asked = all_in(folder);
  CHECK_THROWS_AS(TableFiles(asked, plotted_names, {.inputs = {{"SCENE", folder / "plots" / "one.svg"}}}), core::UsageError);
  CHECK_THROWS_AS(TableFiles(asked, plotted_names, {.outputs = {{"--resume", folder / "table.md"}}}), core::UsageError);
  asked.report = asked.file;
  CHECK_THROWS_AS(TableFiles(asked, plotted_names), core::UsageError);
  asked.report = folder / "plots" / "times.csv";
  CHECK_THROWS_AS(TableFiles(asked, plotted_names), core::UsageError);
  asked.report = folder / "scene.nff";
  CHECK_THROWS_AS(TableFiles(asked, plotted_names, {.inputs = {{"SCENE", folder / "scene.nff"}}}), core::UsageError);
  CHECK(file_text(folder / "scene.nff") == "mine");
}

}  // namespace dmpc::tests::table_files_test
