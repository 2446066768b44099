#include "apps/lab/study/paper/calibration.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/lab/study/paper/tables.h"
#include "core/trace/charge.h"
#include "tests/support/paper_results.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests::calibration_test {

using namespace apps;

namespace {

std::uint64_t price(const nodes::Machine& machine, core::Charge charge) {
  return machine.cost_ps[static_cast<std::size_t>(charge)];
}

/// The calibration's three runs.
std::vector<PaperRun> runs_on(const nodes::Machine& machine, std::uint32_t resolution) {
  PaperRun run{.scene = calibration_scene.scene, .machine = machine, .resolution = resolution};
  std::vector<PaperRun> runs(3, run);
  runs[1].node_count = runs[2].node_count = 2;
  runs[2].machine.cost_ps[static_cast<std::size_t>(core::Charge::cached_lookup)] *= 2;
  return runs;
}

FitTimes times_on(const nodes::Machine& machine, std::uint32_t resolution) {
  const std::vector<PaperRun> runs = runs_on(machine, resolution);
  const PaperResults results = carried_out(runs, paper_subjects(runs));
  return {results[0]->seconds(), results[1]->seconds(), results[2]->seconds()};
}

/// As printed, with a dearer run.
PaperResults calibrated_results(const Catalogue& catalogue) {
  PaperResults results = as_printed(catalogue);
  results[catalogue.dearer_cache] = result_of_seconds(calibration_scene.seconds[1] + 1000);
  return results;
}

}  // namespace

TEST_CASE("on the grid only Mountain on one node and on two is fitted") {
  const Catalogue catalogue = catalogue_of(16);
  std::vector<std::string> calibrated;
  for (const TimedCell& cell : cells_of(catalogue.grid, as_printed(catalogue))) {
    if (cell.is_fitted) {
      calibrated.push_back(std::string(cell.scene().title) + " " + std::to_string(cell.nodes()));
      CHECK_FALSE(cell.is_predicted());
    }
  }
  CHECK(calibrated == std::vector<std::string>{"Mountain 1", "Mountain 2"});
}

TEST_CASE("a calibration of what came out as printed changes nothing, and a slower machine is made faster") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = calibrated_results(catalogue);
  const Table same = calibration(catalogue, results);
  CHECK(same.rows().size() == 2);
  for (const auto& row : same.rows()) {
    CHECK(number(row[1]) == doctest::Approx(number(row[2])));
    CHECK(number(row[3]) == doctest::Approx(0));
  }
  for (const std::size_t run : {catalogue.grid.timed[1][0], catalogue.grid.timed[1][1], catalogue.dearer_cache}) {
    results[run]->total_ns *= 2;
  }
  const Table slower = calibration(catalogue, results);
  CHECK(slower.rows().size() == 2);
  for (const auto& row : slower.rows()) {
    CHECK(number(row[2]) == doctest::Approx(number(row[1]) / 2));
  }
}

TEST_CASE("the calibration rests on its own three runs and on no cell that is predicted") {
  const Catalogue catalogue = catalogue_of(16);
  PaperResults results = calibrated_results(catalogue);
  const Table before = calibration(catalogue, results);
  for (std::size_t run = 0; run < results.size(); ++run) {
    if (run != catalogue.grid.timed[1][0] && run != catalogue.grid.timed[1][1] && run != catalogue.dearer_cache) {
      results[run] = result_of_seconds(7 + run);
    }
  }
  CHECK(calibration(catalogue, results).rows() == before.rows());
}

TEST_CASE("a calibration without its runs is empty and says so, and so is one that dearer look-ups say nothing to") {
  const Catalogue catalogue = catalogue_of(16);
  const Table none = calibration(catalogue, as_printed(catalogue));
  CHECK(none.rows().empty());
  CHECK(none.notes().front() == "Unfinished: 2 of 2 rows are missing.");
  PaperResults results = as_printed(catalogue);
  results[catalogue.dearer_cache] = results[catalogue.grid.timed[1][1]];
  CHECK(calibration(catalogue, results).rows().empty());
  CHECK_FALSE(fit_of({.one = 2, .two = 1, .two_with_dearer_lookups = 1}, {2, 1}).has_value());
  CHECK_FALSE(fit_of({.one = 10, .two = 8, .two_with_dearer_lookups = 9}, {10, 6}).has_value());
  CHECK(fit_of({.one = 10, .two = 8, .two_with_dearer_lookups = 9}, {10, 7})->cached_lookup == 0);
}

TEST_CASE("a fit of closed form: 10 s and 6 s that should be 20 s and 16 s") {
  const auto fit = fit_of({.one = 10, .two = 6, .two_with_dearer_lookups = 7}, {20, 16});
  REQUIRE(fit);
  CHECK(fit->operations == doctest::Approx(2));
  CHECK(fit->cached_lookup == doctest::Approx(3));  // 16 s at half the prices are 8 s: two look-up prices more
}

TEST_CASE("a fitted machine has all prices scaled and that of a cached look-up once more") {
  const nodes::Machine machine = paper_machine(), after = fitted(machine, {.operations = 2, .cached_lookup = 3});
  CHECK(price(after, core::Charge::shading) == 2 * price(machine, core::Charge::shading));
  CHECK(price(after, core::Charge::cached_lookup) == 6 * price(machine, core::Charge::cached_lookup));
  CHECK(after.service_ns == machine.service_ns);
}

TEST_CASE("a machine that was fitted takes the times that it was fitted to, and would be fitted the same way again") {
  constexpr std::uint32_t resolution = 32;
  const std::array<double, 2> wanted = {90, 51};
  const nodes::Machine machine = paper_machine();
  const auto fit = fit_of(times_on(machine, resolution), wanted), again = fit_of(times_on(machine, resolution), wanted);
  REQUIRE((fit && again));
  CHECK(fit->operations == again->operations);
  CHECK(fit->cached_lookup == again->cached_lookup);
  const FitTimes reached = times_on(fitted(machine, *fit), resolution);
  CHECK(reached.one == doctest::Approx(wanted[0]).epsilon(0.002));
  CHECK(reached.two == doctest::Approx(wanted[1]).epsilon(0.01));
}

TEST_CASE("the preset is calibrated: a sixteenth of Mountain's pixels takes about a sixteenth of the printed times") {
  const FitTimes found = times_on(paper_machine(), 128);
  CHECK(16 * found.one == doctest::Approx(calibration_scene.seconds[0]).epsilon(0.02));
  CHECK(16 * found.two == doctest::Approx(calibration_scene.seconds[1]).epsilon(0.02));
}

}  // namespace dmpc::tests::calibration_test
