#include "apps/lab/study/effort.h"

#include <algorithm>
#include <variant>

#include "apps/edge/system/real_load.h"
#include "apps/effort/pilot.h"
#include "apps/info/forecast.h"
#include "dataflow/plan.h"

namespace dmpc::apps {
namespace {

/// So many runs of each node count.
std::vector<PlannedRun> repeated(const std::vector<std::uint32_t>& node_counts, const std::vector<PlannedRun>& each) {
  std::vector<PlannedRun> runs;
  for (const std::uint32_t node_count : node_counts) {
    for (PlannedRun run : each) {
      run.node_count = node_count;
      runs.push_back(run);
    }
  }
  return runs;
}

struct Plan {
  std::vector<PlannedRun> operator()(const BalanceStudy& study) const {
    return repeated(study.node_counts, std::vector<PlannedRun>(BalanceStudy::ways, {Strategy::dataflow}));
  }
  std::vector<PlannedRun> operator()(const TrafficStudy& study) const {
    return repeated(study.node_counts, {{Strategy::dataflow}, {Strategy::svm}, {Strategy::svm}});
  }
  std::vector<PlannedRun> operator()(const CacheStudy& study) const {
    constexpr std::size_t standard_sizes = 12, policies_run = 3;
    constexpr double times = 2.5;  // small caches miss often
    const std::size_t sizes = study.cache_pages.empty() ? standard_sizes : study.cache_pages.size();
    const std::size_t runs = 1 + sizes * (policies_run + (study.machine ? 1 : 0));
    return std::vector<PlannedRun>(runs, {Strategy::svm, study.node_count, true, times});
  }
  std::vector<PlannedRun> operator()(const SpeedupStudy& study) const {
    return repeated(study.node_counts, {{study.run.strategy, 1, true}});
  }
  std::vector<PlannedRun> operator()(const SystemsStudy& study) const {
    std::vector<PlannedRun> each;
    for (const System system : study.chosen) {
      const auto times = std::count_if(study.memories.begin(), study.memories.end(),
                                       [&](const MemoryRule& memory) { return memory.changes(system); });
      const bool has_one = static_cast<std::size_t>(times) < study.memories.size();
      each.insert(each.end(), static_cast<std::size_t>(times) + (has_one ? 1 : 0), {strategy_of(system).strategy, 1, true});
    }
    std::vector<PlannedRun> runs = repeated(study.node_counts, each);
    runs.push_back({Strategy::replicated, 1, true});
    return runs;
  }
};

std::size_t bytes_of(const PlannedRun& run, const Subject& subject) {
  const Forecast one = forecast(subject.database, subject.settings, {run.node_count}, {.balance = dataflow::Balance::equal_size});
  const ComputerForecast& computer = one.computers.front();
  return run.strategy == Strategy::dataflow     ? computer.dataflow->all_bytes
         : run.strategy == Strategy::replicated ? computer.replicated.all_bytes
         : run.strategy == Strategy::forest     ? computer.forest->all_bytes
                                                : computer.svm.all_bytes;
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

std::vector<PlannedRun> planned_runs(const Study& study) { return std::visit(Plan{}, study); }

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
