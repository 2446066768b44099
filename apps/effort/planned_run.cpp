#include "apps/effort/planned_run.h"

namespace dmpc::apps {
namespace {

// Measured on a server's core in November 2026, by processor time: what a run takes for each second of the one-thread renderer,
// and beside that for each node and each pair of nodes.
constexpr double svm_factor = 1.0, dataflow_factor = 1.6;
constexpr double node_seconds = 2e-3, dataflow_pair_seconds = 2e-4;

}  // namespace

std::vector<PlannedRun> planned_for(const std::vector<std::uint32_t>& node_counts, const std::vector<PlannedRun>& each) {
  std::vector<PlannedRun> runs;
  for (const std::uint32_t node_count : node_counts) {
    for (PlannedRun run : each) {
      run.node_count = node_count;
      runs.push_back(run);
    }
  }
  return runs;
}

double seconds_of(const PlannedRun& run, double picture_seconds) {
  const double nodes = run.node_count;
  const double by_rays = dataflow_factor * picture_seconds + dataflow_pair_seconds * nodes * nodes;
  return run.times * ((run.strategy == Strategy::dataflow ? by_rays : svm_factor * picture_seconds) + node_seconds * nodes);
}

}  // namespace dmpc::apps
