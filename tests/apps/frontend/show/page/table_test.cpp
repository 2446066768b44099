#include "apps/frontend/show/page/table.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/text.h"

namespace dmpc::apps::html::page_table_test {

using tests::contains;

TEST_CASE("columns counted in one unit are shown in one that suits their largest number") {
  Table table("Sizes", {{"sent", "bytes"}, {"received", "bytes"}, {"took", "us", 1}});
  table.add_row({std::uint64_t{21'015'780}, std::uint64_t{8'780'000}, 2255.7});
  const std::string text = table_element(table, true);
  CHECK(contains(text, "<th scope=\"col\">sent (MB)</th><th scope=\"col\">received (MB)</th><th scope=\"col\">took (us)</th>"));
  CHECK(contains(text, "<td>21.02</td><td>8.78</td><td>2,255.7</td>"));
}

TEST_CASE("numbers that are too far apart for one unit have one each") {
  Table table("Sizes", {{"carried", "bytes"}});
  table.add_row({std::uint64_t{124'719'920}});
  table.add_row({std::uint64_t{128}});
  table.add_row({std::uint64_t{0}});
  const std::string text = table_element(table, false);
  CHECK(contains(text, "<th scope=\"col\">carried</th>"));
  CHECK(contains(text, "<td>125 MB</td>"));
  CHECK(contains(text, "<td>128 B</td>"));
  CHECK(contains(text, "<td>0 B</td>"));
}

TEST_CASE("small amounts stay in the unit that they were counted in") {
  Table table("Sizes", {{"time", "s", 3}, {"memory", "KiB", 1}, {"few", "bytes"}});
  table.add_row({0.248, 1081.4, std::uint64_t{800}});
  const std::string text = table_element(table, false);
  CHECK(contains(text, "<td>0.248</td><td>1,081.4</td><td>800</td>"));
  CHECK(contains(text, "time (s)</th>"));
}

TEST_CASE("a head has no underscores, and many columns have less room") {
  std::vector<Column> columns = {{"data_wait", "%", 1}};
  CHECK(contains(table_element(Table("Few", columns), false), "<table>\n<thead><tr><th scope=\"col\">data wait (%)</th>"));
  for (int i = 0; i < 11; ++i) {
    columns.push_back({std::to_string(i)});
  }
  CHECK(contains(table_element(Table("Many", columns), false), "<table class=\"dense\">"));
}

TEST_CASE("long texts, and no others, are broken into lines") {
  Table table("Claims", {{"claim"}, {"found"}});
  table.add_row({std::string(61, 'x'), std::string(60, 'y')});
  const std::string text = table_element(table, false);
  CHECK(contains(text, "<td class=\"text long\">x"));
  CHECK(contains(text, "<td class=\"text\">y"));
}

TEST_CASE("the words of a table are its title, columns, texts and notes") {
  Table table("Title", {{"column"}});
  table.add_row({"cell"});
  table.add_note("note");
  CHECK(words_of(table) == "Title\ncolumn\ncell\nnote");
}

}  // namespace dmpc::apps::html::page_table_test
