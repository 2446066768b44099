#include "apps/study_speedup.h"

#include <doctest/doctest.h>

#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/study_subject.h"

namespace dmpc::tests {

namespace {

using apps::Cell;
using apps::SpeedupStrategy;
using apps::SpeedupStudy;
using apps::Table;

double number(const Cell& cell) { return std::get<double>(cell); }

}  // namespace

TEST_CASE("more nodes take less time, at an efficiency below the first row's, and the parts of each row add up") {
  for (const SpeedupStrategy strategy : {SpeedupStrategy::svm, SpeedupStrategy::dataflow}) {
    StudySubject subject("tetra-3");
    const Table table = subject.measure(SpeedupStudy{.node_counts = {1, 3, 8}, .strategy = strategy});
    REQUIRE(table.rows().size() == 3);
    CHECK(number(table.rows()[0][2]) == 1);
    CHECK(number(table.rows()[0][3]) == 100);
    for (const std::vector<Cell>& row : table.rows()) {
      CHECK(number(row[1]) <= number(table.rows()[0][1]));
      CHECK(number(row[3]) <= 100);
      const double parts = std::accumulate(row.begin() + 4, row.begin() + 4 + apps::time_part_count, 0.0,
                                           [](double sum, const Cell& cell) { return sum + number(cell); });
      CHECK(parts == doctest::Approx(100));
    }
  }
}

TEST_CASE("a study of speedup says the same every time, and another machine something else") {
  const auto text_on = [](const char* machine) {
    StudySubject subject("tetra-2");
    const SpeedupStudy study{.node_counts = {4}, .machine = apps::find_machine_preset(machine)->machine};
    return text_of(subject.measure(study), apps::TableFormat::csv);
  };
  CHECK(text_on("ipsc2") == text_on("ipsc2"));
  CHECK(text_on("ipsc2") != text_on("hdr"));
}

}  // namespace dmpc::tests
