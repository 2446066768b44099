#include "apps/frontend/table/table_files.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::plot_folder_test {

using apps::Attempts;
using apps::PlotFolder;

TEST_CASE("a folder of plots has the table, and without a plot no complaint") {
  const TemporaryFolder folder;
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder(folder.path(), complaints).add(apps::Table("Times", {{"nodes"}}), "data.csv", {}, attempts);
  CHECK(file_text(folder / "data.csv").find("nodes") == 0);
  CHECK(complaints.str().empty());
}

TEST_CASE("plots that are not drawn for the same reason are complained of once") {
  const TemporaryFolder folder;
  std::ostringstream complaints;
  Attempts attempts(complaints);
  apps::Table table("Times", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  std::vector<apps::Plot> plots(2, {.name = "one", .title = "Times", .places = {"nodes"}, .series = {{"ours", "time"}}});
  plots[1].name = "two";
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);  // without gnuplot
  PlotFolder(folder.path(), complaints).add(table, "data.csv", plots, attempts);
  ::setenv("PATH", path.c_str(), 1);
  CHECK(count(complaints.str(), "dmpc: ") == 1);
}

TEST_CASE("a folder that is not there is a failed attempt") {
  const TemporaryFolder folder;
  std::ostringstream complaints;
  Attempts attempts(complaints);
  PlotFolder(folder / "none", complaints).add(apps::Table("Times", {{"nodes"}}), "data.csv", {}, attempts);
  CHECK(attempts.status() == 1);
}

}  // namespace dmpc::tests::plot_folder_test
