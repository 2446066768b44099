// How long the runs of a study will take.
#pragma once

#include <vector>

#include "apps/effort/effort.h"
#include "apps/effort/planned_run.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// The effort of all runs, from a few pixels of the picture and from what their nodes ask for.
Effort effort_of(const std::vector<PlannedRun>& runs, const Subject& subject);

}  // namespace dmpc::apps
