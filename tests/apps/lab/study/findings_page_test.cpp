// The page of a study whose table is measured in this process.
#include <doctest/doctest.h>

#include "apps/lab/study/engine/tabled_job.h"
#include "tests/support/text.h"

namespace dmpc::tests::findings_page_test {

TEST_CASE("the page of a study has its conclusion, plots, table and notes") {
  apps::Table table("How it grows", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  table.add_row({std::uint64_t{2}, 5.0});
  table.add_note("A note.");
  const apps::PlotAxis x{.label = "nodes", .scale = apps::PlotScale::powers_of_10};
  const apps::TableResult result = study_result({.title = "Study",
                                                 .table = table,
                                                 .data_file = "study.csv",
                                                 .plots = {apps::curves("time", "Time", "nodes", x, {}, {{"time", "time"}})},
                                                 .conclusion = "It grows.",
                                                 .facts = {{"film", "1daa"}}},
                                                apps::TableFormat::csv);
  const std::string page = result.page();
  for (const char* const word : {"<h1>Study</h1>", "Plot: Time. ", "<td>8.0</td>", "<li>A note.</li>",
                                 "<p class=\"conclusion\">It grows.</p>", ", film 1daa."}) {
    CHECK_MESSAGE(contains(page, word), word);
  }
  CHECK(count(page, "<h2>") == 0);
}

}  // namespace dmpc::tests::findings_page_test
