#include "apps/lab/bench/stability/command.h"

#include <iostream>
#include <limits>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/bench/stability/run.h"
#include "apps/lab/oracle/trial_line.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/oracle/oracle.h"
#include "core/base/expect.h"
#include "core/trace/kernel.h"

namespace dmpc::apps {
namespace {

constexpr int grid_failed_status = 1;

constexpr double per_billion = 1e9;

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

/// Adds what a row's cases have tried, and the number of answers about which something was known.
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

/// Result of our own kernels; the worst case has most failures, then the largest error.
Trial trial_of(const StabilityState& state) {
  Trial trial{.tried = {{0, "ray"}}, .failed = {{state.own_failures(), "failure"}, {state.blind_cases().size(), "blind case"}}};
  std::pair<std::uint64_t, std::uint64_t> most;
  for (const StabilityRow& row : state.rows) {
    for (std::size_t k = 0; k < row.counts.size(); ++k) {
      const auto kernel = static_cast<StabilityKernel>(k);
      const StabilityCounts& counts = row.counts[k];
      const std::pair<std::uint64_t, std::uint64_t> found(counts.failures(), counts.error_milliulp);
      trial.tried.front().first += is_embree(kernel) ? 0 : counts.tried;
      if (!is_embree(kernel) && most < found) {
        most = found;
        trial.worst =
            found.first > 0 ? counted(found.first, "failure") : fixed(static_cast<double>(found.second) / 1000, 3) + " ulp off";
        trial.where = row.name + ", " + std::string(name_of(kernel));
      }
    }
  }
  return trial;
}

void add_notes(Table& table, const StabilityState& state, bool is_whole) {
  if (!is_whole) {
    table.add_note("Ended before its time: cases or rays are missing.");
  }
  for (const std::string& blind : state.blind_cases()) {
    table.add_note("BLIND: nothing was tried of " + blind + ".");
  }
  table.add_note(
      "Leak: a miss that rounding cannot cause. Wrong hit: a hit that rounding cannot cause. Unexplained: other bits than the "
      "grid's, or a distance farther off than rounding moves it. Within rounding: another answer than the grid's, explained by "
      "the referee; no failure.");
  table.add_note(
      "R11 also counts as unexplained each 1,024 rays that take more than 2.5 times the steps and tests of usual ones.");
  table.add_note("The failure rate is below the figure with a confidence of 95 %.");
  table.add_note("Embree is judged by bounds for its robust mode. Its spheres and cones are ours, in double precision.");
  table.add_note(
      "R13, messages out of order: tests/chaos and tests/whole/chaos_test.cpp. R15, known bugs put back: tests/mutation.");
  for (const StabilityRow& row : state.rows) {
    add_tried(table, state, row.name);
  }
  table.add_note(line_of(trial_of(state)));
}

/// Returns a row for each test and each kernel that it tried, in the order of the tests; notes explain the columns, name the
/// tests that run outside the program, and list what each case has tried.
Table table_of(const StabilityState& state, std::uint64_t seed, bool is_whole) {
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
  add_notes(table, state, is_whole);
  return table;
}

}  // namespace

void add_options(OptionSet set, StabilityOptions& options) {
  set.add_number("--rays", options.rays, 1, std::int64_t{1} << 40U, std::to_string(StabilityOptions::standard_rays),
                 "Number of rays for each row of the table");
  set.add_flag("--quick", options.quick, "Same as --rays=10000: some seconds");
  set.add_flag("--long", options.is_long,
               "10^9 rays from inside a closed mesh, 10^8 at its vertices and at its edges, 10^6 to 10^8 of others: hours");
  set.add_text(
      "--tests", "R1,R2,... [all]",
      [&options](const std::string& text) { options.tests = words_between_commas(text, "--tests"); },
      "Run these tests only: R1 to R12, R14, R16, quadrics");
  set.add_number("--seed", options.seed, 0, std::numeric_limits<std::int64_t>::max(), "1", "Seed of the random rays");
  add_options(set, options.table, TableExtras::none);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench stability --quick\n"
      "  dmpc bench stability --tests=R2,R10 --rays=1000000\n"
      "  dmpc bench stability --long -o stability.md\n"
      "The last line summarizes what was tried, what failed, the worst case and where it is.\n"
      "The exit status is 1 if our grid failed, or if a case tried nothing; Embree's results are shown, but not judged.");
  set.check_in_the_end([set, &options] {
    if (int{set.is_given("--rays")} + int{options.quick} + int{options.is_long} > 1) {
      throw core::UsageError("--rays, --quick, --long: expected one of them");
    }
    options.rays = options.quick ? StabilityOptions::quick_rays : options.is_long ? 0 : options.rays;
    stability_cases({options.rays}, options.tests);
  });
}

int bench_stability_command(const StabilityOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files(options.table, {});
  const StabilityCases cases = stability_cases({options.rays}, options.tests);
  StabilityState state;
  const auto measure = [&] {
    Progress progress(std::cerr, stderr_is_terminal(), "", "rays");
    run_stability(cases, options.seed, state, [&] {
      progress.update(state.rays_done, total_rays(cases));
      interrupt.check();
    });
  };
  const auto result = [&](bool is_whole) -> TableResult {
    return {.text = text_of(table_of(state, options.seed, is_whole), options.table.format)};
  };
  const int status = run_tabled({.measure = measure,
                                 .has_findings = [&] { return state.rays_done > 0; },
                                 .consequence = "the table has what was tried before"},
                                result, files, interrupt, output);
  return state.own_failures() == 0 && state.blind_cases().empty() ? status : grid_failed_status;
}

}  // namespace dmpc::apps
