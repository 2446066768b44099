#include "apps/lab/bench/stability/table.h"

#include <string>

#include "apps/edge/line/number_text.h"
#include "apps/edge/table/filled_columns.h"
#include "apps/oracle/oracle.h"
#include "core/trace/kernel.h"

namespace dmpc::apps {
namespace {

constexpr double per_billion = 1e9;

/// What a kernel came to in a test.
struct KernelRow {
  const std::string& test;
  StabilityKernel kernel;
  const StabilityCounts& counts;

  double rate_bound() const { return failure_rate_bound(counts.failures(), counts.tried) * per_billion; }
};

const FilledColumns<KernelRow>& stability_columns() {
  using Row = KernelRow;
  static const FilledColumns<Row> columns = {
      {{"test"}, [](const Row& row) { return row.test; }},
      {{"kernel"}, [](const Row& row) { return std::string(name_of(row.kernel)); }},
      {{"rays tried"}, [](const Row& row) { return row.counts.tried; }},
      {{"leaks"}, [](const Row& row) { return row.counts.leaks; }},
      {{"wrong hits"}, [](const Row& row) { return row.counts.wrong_hits; }},
      {{"double claims"},
       only_if([](const Row& row) { return row.kernel == StabilityKernel::regions; },
               [](const Row& row) { return row.counts.double_claims; })},
      {{"unexplained"}, [](const Row& row) { return row.counts.unexplained; }},
      {{"within rounding"}, [](const Row& row) { return row.counts.explained; }},
      {{"failure rate at most", "per 10^9", 0}, &Row::rate_bound},
      {{"worst error", "ulp", 3},
       only_if([](const Row& row) { return row.counts.error_milliulp > 0; },
               [](const Row& row) { return static_cast<double>(row.counts.error_milliulp) / 1000; })}};
  return columns;
}

/// What a row's cases have tried, and of how many answers something was known.
void add_tried(Table& table, const StabilityState& state, const std::string& row) {
  StabilityCounts sum;
  std::string names;
  for (const StabilityTrial& trial : state.trials) {
    if (trial.row == row) {
      sum += trial.counts;
      names += (names.empty() ? "" : ", ") + trial.name + " " + grouped(trial.counts.tried);
    }
  }
  table.add_note("Tried of " + row + ", answers of all kernels: " + names + ". Sure to hit " + grouped(sum.sure_hits) +
                 ", sure to miss " + grouped(sum.sure_misses) + ", heard by the referee " + grouped(sum.heard) + ".");
}

void add_notes(Table& table, const StabilityState& state) {
  const std::uint64_t failures = state.own_failures();
  table.add_note(failures == 0 ? "Our grid: no failure." : "OUR GRID FAILS: " + std::to_string(failures) + " times.");
  for (const std::string& blind : state.blind_cases()) {
    table.add_note("BLIND: nothing was tried of " + blind + ".");
  }
  table.add_note(
      "Leak: missed what rounding cannot make a ray miss. Wrong hit: hit what rounding cannot make it hit. Unexplained: "
      "other bits than the grid's, or a distance farther off than rounding moves it. Within rounding: another answer "
      "than the grid's, explained by the referee; no failure.");
  table.add_note(
      "R11 also counts as unexplained each 1,024 rays that take more than 2.5 times the steps and tests of usual ones.");
  table.add_note("The failure rate is below the figure with a confidence of 95 %.");
  table.add_note("Embree is judged by bounds for its robust mode. Its spheres and cones are ours, in double precision.");
  table.add_note(
      "R13, messages out of order: tests/chaos and tests/whole/chaos_test.cpp. R15, known bugs put back: tests/mutation.");
  for (const StabilityRow& row : state.rows) {
    add_tried(table, state, row.name);
  }
}

}  // namespace

Table table_of(const StabilityState& state, std::uint64_t seed) {
  Table table("Numerical stability: our grid (" + std::string(core::simd_name()) + ") beside Embree " + embree_version() +
                  ", seed " + std::to_string(seed),
              heads_of(stability_columns()));
  for (const StabilityRow& row : state.rows) {
    for (std::size_t k = 0; k < row.counts.size(); ++k) {
      if (row.counts[k].tried > 0) {
        table.add_row(row_of(stability_columns(), KernelRow{row.name, static_cast<StabilityKernel>(k), row.counts[k]}));
      }
    }
  }
  add_notes(table, state);
  return table;
}

}  // namespace dmpc::apps
