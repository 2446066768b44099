#include "apps/lab/study/studies.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machines.h"
#include "apps/run/render_record.h"
#include "apps/run/run_strategy.h"
#include "tests/support/study_subject.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::speedup_test {

namespace {

using apps::Cell;
using apps::SpeedupStudy;
using apps::Strategy;
using apps::Table;

SpeedupStudy study_of(Strategy strategy, std::vector<std::uint32_t> node_counts) {
  SpeedupStudy study{.node_counts = std::move(node_counts)};
  study.run.strategy = strategy;
  return study;
}

}  // namespace

TEST_CASE("more nodes take less time, at an efficiency below the first row's, and the parts of each row add up") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow, Strategy::replicated}) {
    StudySubject subject("tetra-3");
    const Table table = subject.measure(study_of(strategy, {1, 3, 8}));
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
    SpeedupStudy study{.node_counts = {4}};
    choose_machine(study.run, apps::find_machine_preset(machine)->machine);
    return text_of(subject.measure(study), apps::TableFormat::csv);
  };
  CHECK(text_on("ipsc2") == text_on("ipsc2"));
  CHECK(text_on("ipsc2") != text_on("hdr"));
}

TEST_CASE("a row is that of a run by itself") {
  StudySubject subject("tetra-3");
  const Table table = subject.measure(study_of(Strategy::svm, {1, 5}));
  const svm::Report report = subject.runs.run(
      "again", svm::RunOptions{.computer = {.node_count = 5, .machine = apps::find_machine_preset("ipsc2")->machine}});
  CHECK(real(table, 1, "virtual time") == doctest::Approx(1e-9 * static_cast<double>(report.virtual_time->total_ns)));
  CHECK(cell(table, 1, "run hash") == Cell(apps::hash_text(report.virtual_time->run_hash(report.film.hash()))));
  CHECK(whole(table, 1, "node memory") == report.plan.node_memory_max_bytes());
}

TEST_CASE("node counts that the scene does not fit have a row without figures and a note, and the first that fits is the base") {
  StudySubject subject("tetra-6");
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    SpeedupStudy study = study_of(strategy, {1, 8, 16});
    study.run.computer.node_memory_bytes = 500 << 10U;
    const Table table = subject.measure(study);
    REQUIRE(table.rows().size() == 3);
    CHECK(whole(table, 0, "nodes") == 1);
    for (std::size_t column = 1; column < table.columns().size(); ++column) {
      CHECK(std::holds_alternative<std::monostate>(table.rows()[0][column]));
    }
    CHECK(has_note(table, "1 node: the scene does not fit. --node-memory=500KiB is too small for --nodes=1: "));
    CHECK_FALSE(has_note(table, "8 nodes: the scene does not fit"));
    CHECK(real(table, 1, "speedup") == 8);
    CHECK(real(table, 1, "efficiency") == 100);
    CHECK(real(table, 2, "efficiency") < 100);
  }
}

TEST_CASE("replicated fits nowhere if it does not fit one node") {
  StudySubject subject("tetra-6");
  SpeedupStudy study = study_of(Strategy::replicated, {1, 4});
  study.run.computer.node_memory_bytes = 500 << 10U;
  Table table("", study.columns());
  CHECK_THROWS_WITH_AS(study.measure(subject.runs, table), doctest::Contains("is too small for --nodes=1: "), apps::NothingFits);
  CHECK(is_missing(table, 0, "virtual time"));
  CHECK(is_missing(table, 1, "virtual time"));
  CHECK(has_note(table, "4 nodes: the scene does not fit."));
  CHECK(subject.runs.count() == 0);
}

TEST_CASE("a study of speedup that an error ends has the rows before it") {
  StudySubject subject("balls-1");
  const SpeedupStudy study = study_of(Strategy::dataflow, {1, 2, 4097, 4});
  Table table("", study.columns());
  CHECK_THROWS_AS(study.measure(subject.runs, table), core::UsageError);
  CHECK(table.rows().size() == 2);
}

TEST_CASE("the notes say what ran") {
  SpeedupStudy study = study_of(Strategy::svm, {1});
  CHECK(study.notes("tetra-3").front().find(
            "strategy svm, memory as much as it needs, cache of a quarter of the database (lru), 16 pixels "
            "in flight, work items of 3x3.") != std::string::npos);
  study.run.computer.node_memory_bytes = 1 << 20U;
  study.run.pages = {.cache_pages = 5, .replacement = svm::Replacement::fifo, .in_flight = 4, .work_item_side = 0};
  study.run.computer.machine->has_memory_port = true;
  CHECK(study.notes("tetra-3").front().find("Machine ipsc2 with memory ports (machine_digest ") == 0);
  CHECK(study.notes("tetra-3").front().find(
            "memory 1MiB a node, cache of 5 pages (fifo), 4 pixels in flight, no work given away.") != std::string::npos);
  study = study_of(Strategy::dataflow, {1});
  CHECK(study.notes("tetra-3").front().find("regions by the subsampled picture") != std::string::npos);
}

}  // namespace dmpc::tests::speedup_test
