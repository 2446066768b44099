// The renders of `bench error`: every setting of a scene, round by round, and its reference.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/lab/bench/error/result.h"
#include "apps/lab/oracle/reference/reference.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct MeasureOptions {
  PictureOptions picture;    ///< resolution and convention; samples and depth are the base point's; `scene` is not read
  StrategyOptions strategy;  ///< the strategy that renders, on threads
  std::set<Knob> knobs;      ///< tessellation only if the scene can be tessellated
  bool is_quick = false;
  std::size_t rounds = 3;
  ReferenceOptions reference;
  std::function<void(const SceneResult&)> reported;  ///< called each time that a setting has been rendered for the first time
  std::vector<NamedFile> outputs;                    ///< none of these may be a file that a scene is read from
};

/// Returns `text` as a part of a file's name: every character other than letters, digits and hyphens becomes a hyphen.
std::string file_text(const std::string& text);

/// Computes the reference, then renders every setting once a round. `result` has what is measured so far at any time, also after
/// an exception. Progress goes to stderr if that is a terminal. Throws Interrupted after a signal; core::InputError for an
/// unsuitable scene, memory or file; core::InternalError if a setting's film differs between rounds.
void measure_scene(const std::string& scene, const MeasureOptions& options, const Interrupt& interrupt, SceneResult& result);

}  // namespace dmpc::apps
