// How long one picture will take, once its scene is built.
#pragma once

#include "apps/effort/effort.h"
#include "apps/run/strategy_options.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// The effort of a render, from a few pixels of the picture; for a refined picture of its first pass alone, so at least so long.
/// `subject` has its records still.
Effort render_effort(const StrategyOptions& options, const Subject& subject);

/// The effort of `check`, on one thread.
Effort check_effort(const Subject& subject);

}  // namespace dmpc::apps
