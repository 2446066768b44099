#include "apps/lab/study/sweep/measure.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/study/engine/render_process.h"
#include "apps/lab/study/sweep/kept_databases.h"
#include "apps/lab/study/sweep/kept_runs.h"
#include "apps/lab/study/sweep/table.h"
#include "core/base/expect.h"

namespace dmpc::apps {

void measure_sweep(const SweepSettings& settings, const std::vector<SweepRun>& runs, const OpenedFiles& scene,
                   Interrupt& interrupt, const std::function<void(SweepResult)>& take) {
  const RenderProcesses renders(settings.program, interrupt);
  const std::optional<KeptRuns> kept =
      settings.kept ? std::optional(KeptRuns(*settings.kept, settings.program, scene, figures_of(settings, runs))) : std::nullopt;
  std::optional<KeptDatabases> databases;
  if (kept) {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    databases.emplace(settings, scene, [](const std::string& text) { std::cerr << "dmpc: " << text << std::endl; });
    for (const SweepRun& run : runs) {
      if (!kept->find(run)) {
        databases->provide(run);
      }
    }
  }
  const auto measure = [&](std::size_t i) -> SweepResult {
    interrupt.check();
    if (auto figures = kept ? kept->find(runs[i]) : std::nullopt) {
      return {.run = runs[i], .figures = std::move(figures), .misfit = {}, .is_kept = true};
    }
    try {
      RenderEnd end = renders.run(databases ? databases->words_for(runs[i]) : runs[i].words, std::to_string(i),
                                  [&](const std::filesystem::path& stats) {
                                    if (kept) {
                                      kept->keep(runs[i], stats);
                                    }
                                  });
      return {.run = runs[i], .figures = std::move(end.figures), .misfit = std::move(end.misfit)};
    } catch (const core::InputError& error) {
      throw core::InputError("the run with " + text_of(settings.variations, runs[i]) + " failed: " + error.what());
    }
  };
  const bool is_timed =
      std::any_of(runs.begin(), runs.end(), [](const SweepRun& run) { return is_timed_by_the_wall(run.options); });
  measure_each(runs.size(), is_timed ? Turns::one_by_one : Turns::side_by_side, measure,
               [&](std::size_t, SweepResult result) { take(std::move(result)); });
}

}  // namespace dmpc::apps
