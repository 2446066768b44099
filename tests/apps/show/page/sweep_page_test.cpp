#include "apps/show/page/sweep_page.h"

#include <doctest/doctest.h>

#include <sstream>

#include "tests/support/text.h"

namespace dmpc::apps::html::sweep_page_test {

using tests::contains;

namespace {

Table sweep_table() {
  Table table("How it grows", {{"nodes"}, {"time", "s", 1}});
  table.add_row({std::uint64_t{1}, 8.0});
  table.add_row({std::uint64_t{2}, 5.0});
  table.add_note("A note.");
  return table;
}

}  // namespace

TEST_CASE("a page of a sweep has its texts, plots, tables and notes") {
  const Table table = sweep_table();
  const SweepPart part{
      "Growth",
      table,
      {curves("time", "Time", "nodes", {.label = "nodes", .scale = PlotScale::powers_of_2}, {}, {{"time", "time"}})},
      "It grows."};
  const std::string text = sweep_page({"Sweep", {"A text."}, {part}, {{"film", "1daa"}}}, {.program = "dmpc 1"});
  for (const char* const word : {"<h1>Sweep</h1>", "<p>A text.</p>", "Growth</h2>", "Plot: Time. ", "<td>8.0</td>",
                                 "<li>A note.</li>", "<p class=\"conclusion\">It grows.</p>", "dmpc 1, , film 1daa."}) {
    CHECK_MESSAGE(contains(text, word), word);
  }
}

TEST_CASE("a part without a heading is no section, and no parts are a page all the same") {
  const Table table = sweep_table();
  const SweepPart part{"", table, {}};
  CHECK_FALSE(contains(sweep_page({"Sweep", {}, {part}}, {}), "</h2>\n<div"));
  CHECK(contains(sweep_page({"Sweep", {}, {}}, {}), "<h1>Sweep</h1>"));
}

}  // namespace dmpc::apps::html::sweep_page_test
