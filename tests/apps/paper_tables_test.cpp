#include "apps/paper_tables.h"

#include <doctest/doctest.h>

#include <string>
#include <variant>

#include "apps/paper_claims.h"
#include "core/expect.h"
#include "tests/support/paper_results.h"

namespace dmpc::tests {

using namespace apps;

namespace {

double number(const Cell& cell) { return std::get<double>(cell); }

}  // namespace

TEST_CASE("Table 3 has 24 cells, and results as printed differ by nothing") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults results = as_printed(catalogue);
  CHECK(cells_of_table_3(catalogue, results).size() == 24);
  CHECK(printed_cell_count() == 24);
  const Table table = table_3(catalogue, results);
  CHECK(table.rows().size() == 24);
  for (const auto& row : table.rows()) {
    CHECK(number(row[4]) == 1);
    CHECK(number(row[7]) == 0);
  }
  CHECK(table.notes().back().find("0.00 points on average and 0.00 at worst, 18 cells") != std::string::npos);
}

TEST_CASE("a cell that is two points off is found") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  results[catalogue.timed[0][6]]->total_ns *= 2;
  CHECK(table_3(catalogue, results).notes().back().find("at worst") != std::string::npos);
  const auto cells = cells_of_table_3(catalogue, results);
  CHECK(cells[6].efficiency == doctest::Approx(cells[6].printed_efficiency / 2));
}

TEST_CASE("a table says how many rows are missing, if any, and cannot have more than all") {
  Table table("", {{"a"}});
  table.add_row({std::uint64_t{1}});
  note_missing_rows(table, 1);
  CHECK(table.notes().empty());
  note_missing_rows(table, 2);
  CHECK(table.notes().back() == "Interrupted: 1 of 2 rows are missing.");
  CHECK_THROWS_AS(note_missing_rows(table, 0), core::InternalError);
}

TEST_CASE("differences have a mean and a worst, whatever their sign, and none has neither") {
  Differences differences;
  CHECK(differences.mean() == 0);
  differences.add(-3);
  differences.add(1);
  CHECK(differences.mean() == 2);
  CHECK(differences.worst == 3);
}

TEST_CASE("rows whose runs are missing are left out, and so is what rests on them") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  results[catalogue.timed[3][4]].reset();  // Tetra9's base
  CHECK(cells_of_table_3(catalogue, results).size() == 21);
  CHECK(table_3(catalogue, results).notes().back() == "Interrupted: 3 of 24 rows are missing.");
  CHECK(losses(catalogue, results).notes().back() == "Interrupted: 3 of 24 rows are missing.");
  CHECK(algorithms(catalogue, results).rows().empty());
  CHECK(claims(catalogue, PaperResults(catalogue.runs.size())).rows().empty());
}

}  // namespace dmpc::tests
