#include "apps/frontend/table/table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps::table_table_test {

namespace {

/// It has one of every kind of cell, and one that is missing.
Table small_table() {
  Table table("two runs", {{"nodes"}, {"kind"}, {"average load", "%", 1}});
  table.add_row({std::uint64_t{1234567}, "plain", 82.46});
  table.add_row({std::uint64_t{8}, "missing", {}});
  return table;
}

}  // namespace

TEST_CASE("Markdown has its columns in line, numbers on the right, texts on the left") {
  CHECK(text_of(small_table(), TableFormat::markdown) ==
        "**two runs**\n\n"
        "|     nodes | kind    | average load (%) |\n"
        "|----------:|---------|-----------------:|\n"
        "| 1,234,567 | plain   |             82.5 |\n"
        "|         8 | missing |                  |\n");
}

TEST_CASE("notes stand under a Markdown table as a list") {
  Table table("title", {{"a"}});
  table.add_note("One.");
  table.add_note("Two.");
  CHECK(text_of(table, TableFormat::markdown) == "**title**\n\n| a |\n|--:|\n\n- One.\n- Two.\n");
}

TEST_CASE("a text cannot end its cell or its row in Markdown") {
  Table table("title", {{"a"}});
  table.add_row({"x|y\nz"});
  CHECK(text_of(table, TableFormat::markdown).find("| x\\|y z |\n") != std::string::npos);
}

TEST_CASE("a wide table stands in pieces of 120 letters at most, each with the columns that tell its rows apart") {
  std::vector<Column> columns = {{"scene"}, {"nodes"}};
  for (int i = 0; i < 12; ++i) {
    columns.push_back({"a figure with a long name " + std::to_string(i)});
  }
  Table table("wide", columns);
  for (const std::uint64_t nodes : {1, 2}) {
    std::vector<Cell> row = {"teapot", nodes};
    row.resize(columns.size(), std::uint64_t{7});
    table.add_row(row);
  }
  std::istringstream lines(text_of(table, TableFormat::markdown));
  std::size_t pieces = 0;
  std::string all;
  for (std::string line; std::getline(lines, line); all += line) {
    CHECK(line.size() <= markdown_width_max);
    pieces += line.starts_with("| scene  | nodes | a figure") ? 1 : 0;
  }
  CHECK(pieces == 4);
  for (const Column& column : columns) {
    CHECK(all.find(" " + column.name + " ") != std::string::npos);
  }
}

TEST_CASE("the pieces of a wide table have numbered rows where much would be needed to tell them apart") {
  Table table("alike", {{std::string(80, 'a')}, {std::string(80, 'b')}});
  table.add_row({"x", "y"});
  table.add_row({"x", "y"});
  const std::string text = text_of(table, TableFormat::markdown);
  CHECK(text.find("| row | " + std::string(80, 'a') + " |\n") != std::string::npos);
  CHECK(text.find("|   2 | y ") != std::string::npos);
}

TEST_CASE("a row that is added is told of, as much as fits a line") {
  Table table("two runs", {{"nodes"}, {"kind"}, {"average load", "%", 1}, {std::string(80, 'x')}});
  std::vector<std::string> reported;
  table.set_listener([&reported](const Table& rows) { reported.push_back(row_text(rows, rows.rows().back())); });
  table.add_row({std::uint64_t{4}, "plain", 82.46, "far away"});
  table.add_row({std::uint64_t{8}, "missing", {}, {}});
  CHECK(reported == std::vector<std::string>{"nodes 4, kind plain, average load (%) 82.5", "nodes 8, kind missing"});
}

TEST_CASE("CSV has every digit, nothing for what is missing, and neither title nor notes") {
  Table table = small_table();
  table.add_note("A note.");
  CHECK(text_of(table, TableFormat::csv) ==
        "nodes,kind,average load (%)\n"
        "1234567,plain,82.46\n"
        "8,missing,\n");
}

TEST_CASE("CSV quotes what would be taken for its own signs") {
  Table table("title", {{"a, b"}, {"c"}});
  table.add_row({"he said \"no\"", "two\nlines"});
  CHECK(text_of(table, TableFormat::csv) == "\"a, b\",c\n\"he said \"\"no\"\"\",\"two\nlines\"\n");
}

TEST_CASE("a text that spreadsheets would take for a formula is text in CSV, and a number stays one") {
  Table table("title", {{"name"}, {"change", "%"}});
  table.add_row({"=1+1", -2.5});
  table.add_row({"@SUM(A1)", 2.5});
  table.add_row({"-2+3+cmd", {}});
  table.add_row({"-", {}});
  table.add_row({"+5 %", {}});
  CHECK(text_of(table, TableFormat::csv) == "name,change (%)\n'=1+1,-2.5\n'@SUM(A1),2.5\n'-2+3+cmd,\n-,\n'+5 %,\n");
}

TEST_CASE("JSON lines are the rows alone, each an object") {
  Table table = small_table();
  table.add_note("A note.");
  const std::string lines = text_of(table, TableFormat::json_lines);
  CHECK(static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n')) == table.rows().size());
  CHECK(lines.starts_with("{\"nodes\":"));
  CHECK(lines.find("note") == std::string::npos);
  CHECK(text_of(Table("", {{"a"}}), TableFormat::json_lines).empty());
}

TEST_CASE("JSON names columns and units, and has null for what is missing") {
  Table table = small_table();
  table.add_note("A note.");
  CHECK(text_of(table, TableFormat::json) ==
        "{\n  \"format\": 2,\n  \"title\": \"two runs\",\n"
        "  \"columns\": [\n"
        "    {\n      \"name\": \"nodes\",\n      \"unit\": null\n    },\n"
        "    {\n      \"name\": \"kind\",\n      \"unit\": null\n    },\n"
        "    {\n      \"name\": \"average_load\",\n      \"unit\": \"%\"\n    }\n  ],\n"
        "  \"rows\": [\n"
        "    {\n      \"nodes\": 1234567,\n      \"kind\": \"plain\",\n      \"average_load\": 82.46\n    },\n"
        "    {\n      \"nodes\": 8,\n      \"kind\": \"missing\",\n      \"average_load\": null\n    }\n  ],\n"
        "  \"notes\": [\n    \"A note.\"\n  ]\n}\n");
}

TEST_CASE("a table without rows or columns can be written") {
  CHECK(text_of(Table("", {}), TableFormat::csv) == "\n");
  CHECK(text_of(Table("", {{"a"}}), TableFormat::csv) == "a\n");
  CHECK(text_of(Table("", {{"a"}}), TableFormat::json).find("\"rows\": []") != std::string::npos);
}

TEST_CASE("the largest numbers are written in full") {
  Table table("title", {{"whole"}, {"real", "", 1}});
  table.add_row({~std::uint64_t{0}, std::numeric_limits<double>::max()});
  CHECK(text_of(table, TableFormat::csv).find("18446744073709551615,1.7976931348623157e+308") != std::string::npos);
  CHECK(text_of(table, TableFormat::markdown).find("18,446,744,073,709,551,615") != std::string::npos);
}

TEST_CASE("a name of a file that is no text is replaced in JSON, not refused") {
  Table table("title", {{"a"}});
  table.add_row({"\xff"});
  CHECK(text_of(table, TableFormat::json).find("\"a\"") != std::string::npos);
}

TEST_CASE("rows of another length, numbers that are none, and columns of one name are refused") {
  Table table("title", {{"a"}, {"b"}});
  CHECK_THROWS_AS(table.add_row({1.0}), core::InternalError);
  CHECK_THROWS_AS(table.add_row({1.0, 2.0, 3.0}), core::InternalError);
  CHECK_THROWS_AS(table.add_row({1.0, std::numeric_limits<double>::quiet_NaN()}), core::InternalError);
  CHECK_THROWS_AS(table.add_row({1.0, std::numeric_limits<double>::infinity()}), core::InternalError);
  CHECK(table.rows().empty());
  CHECK_THROWS_AS(Table("title", {{"a"}, {"a"}}), core::InternalError);
}

}  // namespace dmpc::apps::table_table_test
