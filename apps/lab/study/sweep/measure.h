// The runs of a sweep, each a separate `dmpc render`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/figures/figures_file.h"
#include "apps/lab/study/sweep/settings.h"

namespace dmpc::apps {

struct SweepResult {
  SweepRun run;
  std::optional<std::vector<Figure>> figures;  ///< of its --stats; nothing if there was not enough memory
  std::string misfit;                          ///< if there are no figures: why
  bool is_kept = false;                        ///< from an earlier sweep
};

/// Runs them in order, as many at a time as there are cores; one at a time if one of them has a thread for each node, since that
/// is timed by the wall clock. `scene` lists the files from which the scene is read. `take` gets the results one by one, in
/// order, in the calling thread or another. Throws core::InputError, which names the run, if one fails for another reason than
/// lack of memory; Interrupted after a signal.
void measure_sweep(const SweepSettings& settings, const std::vector<SweepRun>& runs, const OpenedFiles& scene,
                   Interrupt& interrupt, const std::function<void(SweepResult)>& take);

}  // namespace dmpc::apps
