#include "apps/lab/study/engine/timed_render.h"

#include <cstdint>
#include <utility>

#include "apps/run/run_strategy.h"

namespace dmpc::apps {

TimedRender render_timed(const StrategyOptions& options, const core::Database& database, const core::RenderSettings& settings,
                         const Interrupt& interrupt) {
  const ReadyRun run = make_ready(options, database, settings, interrupt.token());
  interrupt.check();
  DoubleStopwatch stopwatch;
  Report report = run.start([](std::uint32_t, std::uint32_t) {}, interrupt.token());
  const Times times = stopwatch.lap();
  interrupt.check();
  return {std::move(report), times};
}

}  // namespace dmpc::apps
