#include "apps/frontend/show/page/charts.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::html::charts_test {

using tests::contains;

namespace {

Table numbers() {
  Table table("Numbers", {{"x"}, {"y"}});
  table.add_row({std::uint64_t{1}, 2.0});
  table.add_row({std::uint64_t{2}, 3.0});
  return table;
}

Plot line(const std::string& column = "y") {
  return curves("numbers", "Numbers", "x", {.label = "x"}, {.label = "y"}, {{"y", column}});
}

}  // namespace

TEST_CASE("a plot becomes an address with its own bytes") {
  std::ostringstream complaints;
  CHECK(Charts(complaints).draw(line(), numbers()).starts_with("data:image/svg+xml;base64,"));
  CHECK(complaints.str().empty());
}

TEST_CASE("without the program there is no plot, and one complaint") {
  std::ostringstream complaints;
  Charts charts(complaints, "requester", "/none/gnuplot");
  CHECK(charts.draw(line(), numbers()).empty());
  CHECK(charts.draw(line(), numbers()).empty());
  CHECK(complaints.str().starts_with("requester: the page has no plots: /none/gnuplot cannot be started"));
  CHECK(complaints.str().find('\n') == complaints.str().size() - 1);
}

TEST_CASE("a plot that is drawn and cannot be read back is missed, and told") {
  const tests::TemporaryFolder folder;
  const std::string program = folder / "draws-nothing";
  tests::write_text(program, "#!/bin/sh\n: > \"${1%.gnuplot}.svg\"\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  std::ostringstream complaints;
  CHECK(Charts(complaints, "requester", program).draw(line(), numbers()).empty());
  CHECK(complaints.str() == "requester: the page lacks a plot: numbers.svg is drawn, and cannot be read back\n");
}

TEST_CASE("a plot without a number is left out without complaint") {
  std::ostringstream complaints;
  CHECK(Charts(complaints).draw(line(), Table("Numbers", {{"x"}, {"y"}})).empty());
  CHECK(complaints.str().empty());
}

TEST_CASE("what is black is light where the page is dark") {
  const std::string svg = themed("<svg>\n<g id=\"gnuplot_canvas\"></g></svg>");
  CHECK(contains(svg, "<svg>\n<style>"));
  CHECK(contains(svg, "prefers-color-scheme:dark"));
  CHECK(themed("nothing").find("style") == std::string::npos);
}

}  // namespace dmpc::apps::html::charts_test
