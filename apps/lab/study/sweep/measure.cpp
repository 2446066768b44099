#include "apps/lab/study/sweep/measure.h"

#include <algorithm>
#include <utility>

#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/system/watched_process.h"
#include "apps/lab/study/engine/measure_each.h"
#include "apps/lab/study/render_process.h"
#include "apps/lab/study/sweep/kept_runs.h"
#include "apps/lab/study/sweep/table.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

class SweepBench {
 public:
  SweepBench(const SweepSettings& settings, const std::vector<SweepRun>& runs, const OpenedFiles& scene,
             const Interrupt& interrupt)
      : settings_(settings), interrupt_(interrupt) {
    if (settings.kept) {
      kept_.emplace(*settings.kept, settings.program, scene, figures_of(settings, runs));
    }
  }

  /// From any thread; `number` is no other run's.
  SweepResult measure(const SweepRun& run, std::size_t number) const {
    interrupt_.check();
    if (auto figures = kept_ ? kept_->find(run) : std::nullopt) {
      return {.run = run, .figures = std::move(figures), .misfit = {}, .is_kept = true};
    }
    const std::string name = std::to_string(number);
    const std::filesystem::path stats = folder_ / (name + ".json"), picture = folder_ / (name + ".exr");
    const WatchedProcess process = watch_process(settings_.program, render_words(run, stats, picture), interrupt_);
    std::error_code ignored;
    std::filesystem::remove(picture, ignored);
    if (const std::optional<std::string> misfit = misfit_or_throw(run, process)) {
      return {.run = run, .figures = {}, .misfit = *misfit};
    }
    std::vector<Figure> figures = read_figures(stats);
    if (kept_) {
      kept_->keep(run, stats);
    }
    return {.run = run, .figures = std::move(figures), .misfit = {}};
  }

 private:
  std::optional<std::string> misfit_or_throw(const SweepRun& run, const WatchedProcess& process) const {
    try {
      return misfit_of(process);
    } catch (const core::InputError& error) {
      throw core::InputError("the run with " + text_of(settings_.variations, run) + " failed: " + error.what());
    }
  }

  const SweepSettings& settings_;
  const Interrupt& interrupt_;
  std::optional<KeptRuns> kept_;
  ScratchFolder folder_;
};

}  // namespace

void measure_sweep(const SweepSettings& settings, const std::vector<SweepRun>& runs, const OpenedFiles& scene,
                   const Interrupt& interrupt, const std::function<void(SweepResult)>& take) {
  const SweepBench bench(settings, runs, scene, interrupt);
  const bool is_timed =
      std::any_of(runs.begin(), runs.end(), [](const SweepRun& run) { return is_timed_by_the_wall(run.options); });
  measure_each(
      runs.size(), is_timed ? Turns::one_by_one : Turns::side_by_side, [&](std::size_t i) { return bench.measure(runs[i], i); },
      [&](std::size_t, SweepResult result) { take(std::move(result)); });
}

}  // namespace dmpc::apps
