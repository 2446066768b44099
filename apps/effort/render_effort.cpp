#include "apps/effort/render_effort.h"

#include <algorithm>

#include "apps/edge/system/real_load.h"
#include "apps/effort/pilot.h"
#include "apps/effort/planned_run.h"

namespace dmpc::apps {
namespace {

/// Measured on a server's core in November 2026: what Embree and the comparison take besides.
constexpr double check_factor = 1.5;

}  // namespace

Effort render_effort(const StrategyOptions& options, const Subject& subject) {
  const bool is_virtual = options.runner.kind == RunnerKind::virtual_time;
  const double seconds = seconds_of({options.strategy, options.computer.node_count, is_virtual},
                                    picture_seconds(subject.database, subject.settings));
  return {.seconds = is_virtual ? seconds
                                : seconds / std::min({core_count(), options.computer.node_count,
                                                      options.computer.pool_threads.value_or(nodes::node_count_max)})};
}

Effort check_effort(const Subject& subject) {
  return {.seconds = check_factor * picture_seconds(subject.database, subject.settings)};
}

}  // namespace dmpc::apps
