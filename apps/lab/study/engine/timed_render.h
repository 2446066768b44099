// Times the phase `render` of a render without observers.
#pragma once

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/run/report.h"
#include "apps/run/strategy_options.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

struct TimedRender {
  Report report;
  Times times;
};

/// Prepares the run, then times it. Throws as make_ready() and the run do, Interrupted if a signal comes before its end.
TimedRender render_timed(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                         const Interrupt& interrupt);

}  // namespace dmpc::apps
