#include "apps/paper_tables.h"

#include <doctest/doctest.h>

#include <string>
#include <variant>

#include "apps/paper_claims.h"

namespace dmpc::apps {

namespace {

/// Results as if every cell of Table 3 had come out as printed.
PaperResults as_printed(const Catalogue& catalogue) {
  PaperResults results(catalogue.runs.size());
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      results[catalogue.timed[scene][column]] = PaperResult{.total_ns = paper_scenes[scene].seconds[column] * 1'000'000'000ULL};
    }
  }
  return results;
}

double number(const Cell& cell) { return std::get<double>(cell); }

}  // namespace

TEST_CASE("Table 3 has 24 cells, and results as printed differ by nothing") {
  const Catalogue catalogue = catalogue_of(16);
  const PaperResults results = as_printed(catalogue);
  CHECK(cells_of_table_3(catalogue, results).size() == 24);
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

TEST_CASE("rows whose runs are missing are left out, and so is what rests on them") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  results[catalogue.timed[3][4]].reset();  // Tetra9's base
  CHECK(cells_of_table_3(catalogue, results).size() == 21);
  CHECK(algorithms(catalogue, results).rows().empty());
  CHECK(calibration(catalogue, results).rows().empty());
  CHECK(claims(catalogue, PaperResults(catalogue.runs.size())).rows().empty());
}

TEST_CASE("a calibration of what came out as printed changes nothing, and a slower machine is made faster") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = as_printed(catalogue);
  results[catalogue.dearer_cache] = PaperResult{.total_ns = results[catalogue.timed[1][1]]->total_ns + 1'000'000'000'000ULL};
  const Table same = calibration(catalogue, results);
  for (const auto& row : same.rows()) {
    CHECK(number(row[1]) == doctest::Approx(number(row[2])));
  }
  for (const std::size_t run : {catalogue.timed[1][0], catalogue.timed[1][1], catalogue.dearer_cache}) {
    results[run]->total_ns *= 2;
  }
  const Table slower = calibration(catalogue, results);
  for (const auto& row : slower.rows()) {
    CHECK(number(row[2]) == doctest::Approx(number(row[1]) / 2));
  }
}

}  // namespace dmpc::apps
