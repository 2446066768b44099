// The runs of the study `scale`: each is a separate `dmpc render` whose memory is observed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/scale/figures.h"
#include "apps/lab/study/scale/settings.h"

namespace dmpc::apps {

struct ScaleResult {
  ScaleRun run;
  std::optional<ScaleFigures> figures;
  std::string misfit;  ///< if there are no figures: a sentence that says why, without its full stop
};

/// Returns the words after `dmpc`, without outputs.
std::vector<std::string> render_arguments(const ScaleRun& run, const ScaleSettings& settings);

/// Carries the runs out one after the other, each settings.rounds times, and reports each to `take`; progress goes to stderr if
/// that is a terminal. A run for which this computer or the nodes have not enough memory is a misfit. Throws Interrupted after a
/// signal, core::InputError if the program cannot be run or refuses its input for another reason, core::InternalError if the
/// program fails or two runs of a scene give different films: `take` has then received all runs before.
void measure_scale(const std::vector<ScaleRun>& runs, const ScaleSettings& settings, const Interrupt& interrupt,
                   const std::function<void(ScaleResult)>& take);

}  // namespace dmpc::apps
