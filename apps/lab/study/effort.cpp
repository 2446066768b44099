#include "apps/lab/study/effort.h"

#include <algorithm>

#include "apps/edge/system/real_load.h"
#include "apps/effort/pilot.h"
#include "apps/info/forecast.h"
#include "dataflow/plan.h"

namespace dmpc::apps {
namespace {

/// A strategy that this structure of the scene is not for runs on another, and is taken to ask for as much as svm does.
std::size_t bytes_of(const PlannedRun& run, const Subject& subject) {
  const Forecast one = forecast(subject.database, subject.settings, {run.node_count}, {.balance = dataflow::Balance::equal_size});
  const ComputerForecast& computer = one.computers.front();
  switch (run.strategy) {
    case Strategy::dataflow:
      return computer.dataflow.value_or(computer.svm).all_bytes;
    case Strategy::forest:
      return computer.forest.value_or(computer.svm).all_bytes;
    case Strategy::replicated:
      return computer.replicated.all_bytes;
    case Strategy::svm:
      break;
  }
  return computer.svm.all_bytes;
}

/// The bytes of the largest computers, as many as there are at a time.
std::size_t bytes_at_once(const std::vector<PlannedRun>& runs, const Subject& subject) {
  const auto largest =
      std::max_element(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.node_count < b.node_count; });
  const std::size_t at_once = largest->is_virtual ? std::min<std::size_t>(core_count(), runs.size()) : 1;
  const auto alike = static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [&](const auto& run) { return run.node_count == largest->node_count; }));
  return std::min(alike, at_once) * bytes_of(*largest, subject);
}

}  // namespace

Effort effort_of(const std::vector<PlannedRun>& runs, const Subject& subject) {
  const double picture = picture_seconds(subject.database, subject.settings);
  double all = 0, longest = 0;
  for (const PlannedRun& run : runs) {
    const double seconds = seconds_of(run, picture);
    all += seconds;
    longest = std::max(longest, run.is_virtual ? seconds : seconds / core_count());
  }
  return {std::max(longest, all / core_count()), bytes_at_once(runs, subject), true};
}

}  // namespace dmpc::apps
