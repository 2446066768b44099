// What a study will render, and how long that will take.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/effort/effort.h"
#include "apps/scene/subject.h"
#include "apps/study/options.h"

namespace dmpc::apps {

/// A render that a study is going to make.
struct PlannedRun {
  Strategy strategy = Strategy::svm;
  std::uint32_t node_count = 1;
  bool is_virtual = false;  ///< as many at a time as there are cores, each on one; else one at a time, by threads
  double times = 1;         ///< as long as usual
};

/// In their order; of a study whose runs depend on the first one about as many.
std::vector<PlannedRun> planned_runs(const Study& study);

/// Of one run, from what the one-thread renderer takes for the picture. By processor time.
double seconds_of(const PlannedRun& run, double picture_seconds);

/// Of all runs, from a few pixels of the picture and from what their nodes ask for.
Effort effort_of(const std::vector<PlannedRun>& runs, const Subject& subject);

}  // namespace dmpc::apps
