// What a study will render, and how long that will take.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/effort/effort.h"
#include "apps/effort/planned_run.h"
#include "apps/lab/study/options.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// In their order; of a study whose runs depend on the first one about as many.
std::vector<PlannedRun> planned_runs(const Study& study);

/// The effort of all runs, from a few pixels of the picture and from what their nodes ask for.
Effort effort_of(const std::vector<PlannedRun>& runs, const Subject& subject);

}  // namespace dmpc::apps
