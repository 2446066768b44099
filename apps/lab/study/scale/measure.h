// The runs of the study `scale`: each is a `dmpc render` of its own, whose memory is watched.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/study/scale/figures.h"
#include "apps/lab/study/scale/settings.h"

namespace dmpc::apps {

/// What became of a run.
struct ScaleResult {
  ScaleRun run;
  std::optional<ScaleFigures> figures;
  std::string misfit;  ///< without figures: a sentence that says why, without its full stop
};

/// The words after `dmpc`, but for its outputs.
std::vector<std::string> render_arguments(const ScaleRun& run, const ScaleSettings& settings);

/// Carries the runs out one after the other, each settings.rounds times, and tells `take` of each; progress goes to stderr if
/// that is a terminal. A run that this computer or the nodes' memory has no room for is a misfit. Throws Interrupted after a
/// signal, core::InputError if the program cannot be run or refuses its input for another reason than a lack of room,
/// core::InternalError if it fails by a fault of its own or two runs of a scene give different films: `take` has then been told
/// of all runs before.
void measure_scale(const std::vector<ScaleRun>& runs, const ScaleSettings& settings, const Interrupt& interrupt,
                   const std::function<void(ScaleResult)>& take);

}  // namespace dmpc::apps
