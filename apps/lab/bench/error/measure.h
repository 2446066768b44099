// The renders of `bench error`: every setting of a scene, round by round, beside its reference.
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
  StrategyOptions strategy;  ///< that renders, on threads
  std::set<Knob> knobs;      ///< tessellation only of scenes that can be
  bool is_quick = false;
  std::size_t rounds = 3;
  ReferenceOptions reference;
  std::function<void(const SceneResult&)> reported;  ///< each time that a setting has been rendered for the first time
  std::vector<NamedFile> outputs;                    ///< none of which may be a file that a scene is read from
};

/// `text` as a part of a file's name: letters, digits and hyphens; what else it has becomes a hyphen.
std::string file_text(const std::string& text);

/// Finds the reference, then renders every setting once a round. `result` has what is measured so far at any time, thrown at or
/// not. Progress goes to stderr if that is a terminal. Throws Interrupted after a signal; core::InputError for a scene, a memory
/// or a file that will not do; core::InternalError if a setting's film differs between rounds.
void measure_scene(const std::string& scene, const MeasureOptions& options, const Interrupt& interrupt, SceneResult& result);

}  // namespace dmpc::apps
