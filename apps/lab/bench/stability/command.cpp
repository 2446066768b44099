#include "apps/lab/bench/stability/command.h"

#include <chrono>
#include <iostream>
#include <limits>

#include "apps/edge/line/words.h"
#include "apps/edge/system/progress.h"
#include "apps/edge/table/table_files.h"
#include "apps/lab/bench/stability/run.h"
#include "apps/lab/bench/stability/state.h"
#include "apps/lab/bench/stability/table.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int failed_status = 1;
constexpr std::chrono::minutes save_interval{1};

/// What a state must share with the run that goes on from it.
std::string identity_of(const StabilityOptions& options) {
  std::string text = "seed " + std::to_string(options.seed) + ", ";
  text += options.rays == 0 ? "the long run's rays" : std::to_string(options.rays) + " rays";
  text += ", tests ";
  for (const std::string& test : options.tests) {
    text += test + " ";
  }
  return text + (options.tests.empty() ? "all" : "");
}

TableFiles files_of(const StabilityOptions& options) {
  OtherFiles others;
  if (options.resume) {
    others.outputs.push_back({"--resume", *options.resume});
  }
  return {options.table, {}, others};
}

/// A run whose state is kept in a file, if one is asked for.
class KeptRun {
 public:
  KeptRun(const StabilityOptions& options, const StabilityRun& run) : options_(options), run_(run), state_(run.start()) {
    if (options.resume) {
      load_state(*options.resume, state_, identity_of(options));
    }
  }

  const StabilityState& state() const { return state_; }

  void finish(Interrupt& interrupt) {
    Progress progress(std::cerr, stderr_is_terminal(), "", "rays");
    try {
      run_.go_on(state_, [&] {
        progress.update(run_.rays_done(state_), run_.total_rays());
        save_now_and_then();
        interrupt.check();
      });
    } catch (const Interrupted&) {
      save();
      interrupt.set_consequence(options_.resume ? "the same command goes on from here" : "nothing was written");
      throw;
    }
    save();
  }

 private:
  void save_now_and_then() {
    if (Clock::now() - saved_ > save_interval) {
      save();
    }
  }
  void save() {
    if (options_.resume) {
      save_state(*options_.resume, state_, identity_of(options_));
    }
    saved_ = Clock::now();
  }

  const StabilityOptions& options_;
  const StabilityRun& run_;
  StabilityState state_;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace

void add_options(OptionSet set, StabilityOptions& options) {
  set.add_number("--rays", options.rays, 1, std::int64_t{1} << 40U, std::to_string(StabilityOptions::standard_rays),
                 "Rays of each row of the table");
  set.add_flag("--quick", options.quick, "As --rays=10000: some seconds");
  set.add_flag("--long", options.is_long,
               "10^9 rays from inside a closed mesh, 10^8 at its vertices and at its edges, 10^6 to 10^8 of others: hours");
  set.add_text(
      "--tests", "R1,R2,... [all]",
      [&options](const std::string& text) { options.tests = words_between_commas(text, "--tests"); },
      "Only these: R1 to R12, R14, R16, quadrics");
  set.add_number("--seed", options.seed, 0, std::numeric_limits<std::int64_t>::max(), "1", "Other rays, as good as these");
  set.add_path("--resume", "FILE", options.resume, "Keep the run's state in FILE, and go on from there if it exists");
  add_options(set, options.table, TableExtras::none);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench stability --quick\n"
      "  dmpc bench stability --tests=R2,R10 --rays=1000000\n"
      "  dmpc bench stability --long --resume=long.state -o stability.md\n"
      "Exit status 1 says that our grid failed, or that a case tried nothing; what Embree does is shown, not judged.");
  set.check_in_the_end([set, &options] {
    if (int{set.is_given("--rays")} + int{options.quick} + int{options.is_long} > 1) {
      throw core::UsageError("--rays, --quick, --long: expected one of them");
    }
    options.rays = options.quick ? StabilityOptions::quick_rays : options.is_long ? 0 : options.rays;
    stability_cases({options.rays}, options.tests);
  });
}

int bench_stability_command(const StabilityOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  const StabilityRun run(stability_cases({options.rays}, options.tests), options.seed);
  KeptRun kept(options, run);
  const auto result = [&](bool) -> TableResult {
    return {.text = text_of(table_of(kept.state(), options.seed), options.table.format)};
  };
  const int status = run_tabled({.measure = [&] { kept.finish(interrupt); }, .consequence = "nothing was written"}, result, files,
                                interrupt, output);
  return kept.state().own_failures() == 0 && kept.state().blind_cases().empty() ? status : failed_status;
}

}  // namespace dmpc::apps
