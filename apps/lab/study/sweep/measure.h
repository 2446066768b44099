// The runs of a sweep, each a `dmpc render` of its own.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/figures/figures_file.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

/// What became of a run.
struct SweepResult {
  SweepRun run;
  std::optional<std::vector<Figure>> figures;  ///< what its --stats has; nothing if there was no room for it
  std::string misfit;                          ///< without figures: why
  bool is_kept = false;                        ///< by an earlier sweep
};

/// Runs them in order, as many at a time as there are cores; one at a time if one of them has a thread for each node, since that
/// is timed by the wall clock. `scene` is what the scene is read from. `take` gets the results one by one, in order, in the
/// thread that called or another. Throws core::InputError if a run goes wrong otherwise than by a lack of room, saying which;
/// Interrupted after a signal.
void measure_sweep(const SweepSettings& settings, const std::vector<SweepRun>& runs, const OpenedFiles& scene,
                   const Interrupt& interrupt, const std::function<void(SweepResult)>& take);

}  // namespace dmpc::apps
