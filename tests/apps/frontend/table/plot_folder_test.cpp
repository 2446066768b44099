#include "apps/frontend/table/table_files.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::plot_folder_test {

using apps::Attempts;
using apps::PlotFolder;

namespace {

apps::Table two_times() {
  apps::Table table("Times", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  table.add_row({std::uint64_t{2}, 5.0});
  return table;
}

apps::Plot plot_of(const std::string& name) {
  return {.name = name, .title = "Times", .place = "nodes", .series = {{"ours", "time"}}};
}

}  // namespace

TEST_CASE("a folder of plots has the table, and what each of them draws") {
  const TemporaryFolder folder;
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder(folder.path()).add(two_times(), "data.csv", std::vector{plot_of("one")}, attempts);
  CHECK(file_text(folder / "data.csv").find("nodes") == 0);
  CHECK(contains(file_text(folder / "one.json"), "[[1.0,8.0],[2.0,5.0]]"));
  CHECK(folder.entry_count() == 2);
}

TEST_CASE("of a plot without a row nothing stays, and nothing is drawn") {
  const TemporaryFolder folder;
  write_text(folder / "one.svg", "old");
  write_text(folder / "one.json", "old");
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder plots(folder.path());
  plots.add(apps::Table("Times", two_times().columns()), "data.csv", std::vector{plot_of("one")}, attempts);
  plots.draw(complaints);
  CHECK(folder.entry_count() == 1);
  CHECK(complaints.str().empty());
}

TEST_CASE("what prevents plots from being drawn is said once, and old pictures are gone") {
  const TemporaryFolder folder;
  write_text(folder / "one.svg", "old");
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder plots(folder.path());
  plots.add(two_times(), "data.csv", std::vector{plot_of("one"), plot_of("two")}, attempts);
  const char* const path = std::getenv("PYTHONPATH");
  const std::string before = path == nullptr ? "" : path;
  write_text(folder / "dmpc", "no folder");
  ::setenv("PYTHONPATH", folder.path().c_str(), 1);
  plots.draw(complaints);
  ::setenv("PYTHONPATH", before.c_str(), 1);
  CHECK(count(complaints.str(), "dmpc: the plots are not drawn: ") == 1);
  CHECK(contains(complaints.str(), "apt-get install python3-"));
  CHECK_FALSE(std::filesystem::exists(folder / "one.svg"));
  CHECK(attempts.status() == 0);
}

TEST_CASE("a folder that is not there is a failed attempt") {
  const TemporaryFolder folder;
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder(folder / "none").add(two_times(), "data.csv", {}, attempts);
  CHECK(attempts.status() == 1);
}

}  // namespace dmpc::tests::plot_folder_test
