// Observers beside svm's nodes see what the nodes count, by either clock, and with messages late and out of order.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "nodes/observers/activity_profile.h"
#include "nodes/observers/observer_group.h"
#include "svm/pages/observers/fetch_observer.h"
#include "tests/support/priced_machine.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace dmpc::tests::watch_test {
namespace {

constexpr std::uint32_t watchers_nodes = 4;

Subject subject_to_watch() {
  core::BuildOptions options;
  options.page_size_bytes = 512;
  return Subject(core::built_in_scene(core::parse_scene_name("balls-2")), {.width = 8, .height = 8, .knows_background = true},
                 options);
}

std::uint64_t sum_over(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Runs with all observers, and holds what they saw against what was counted.
void check_watched(const Subject& subject, svm::RunOptions options, svm::PageHomes homes) {
  const auto page_count = static_cast<std::uint32_t>(subject.database().page_count());
  nodes::ActivityProfile profile(watchers_nodes + 1,
                                 [](const nodes::Span& span) { return static_cast<std::size_t>(span.activity); });
  svm::FetchObserver observer(watchers_nodes, page_count, svm::fetch_sample_max, homes);
  nodes::ObserverGroup group({&profile, &observer});
  std::vector<svm::ReferenceLog> logs(watchers_nodes, svm::ReferenceLog(1000));
  options.computer.node_count = watchers_nodes;
  options.pages.cache_pages = 2;
  options.pages.homes = homes;
  options.watching.observer = &group;
  options.pages.reference_logs = &logs;
  const svm::Report report = run_svm(subject, options);
  CHECK(outcome_of(report) == subject.outcome());
  const svm::Fetches fetches = observer.take();
  CHECK(report.pages().faults > 20);
  CHECK(sum_over(fetches.by_pair) == report.pages().faults);
  CHECK(sum_over(fetches.by_page) == report.pages().faults);
  CHECK(fetches.sample.size() == report.pages().faults);
  CHECK(std::all_of(logs.begin(), logs.end(), [](const svm::ReferenceLog& log) { return !log.pages().empty(); }));
  CHECK(!profile.take().nodes[0].empty());
}

}  // namespace

TEST_CASE("observers see every fetch, by threads, in virtual time and under chaos") {
  const Subject small = subject_to_watch();
  for (const svm::PageHomes homes : {svm::PageHomes::spread, svm::PageHomes::host, svm::PageHomes::tree}) {
    check_watched(small, {}, homes);
    check_watched(small, {.computer = {.machine = priced_machine()}}, homes);
    for (const std::uint64_t seed : {1, 2, 3}) {
      check_watched(small, {.computer = {.chaos = nodes::chaos_of(seed)}}, homes);
    }
  }
}

}  // namespace dmpc::tests::watch_test
