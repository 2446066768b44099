// The observers of a program's run that its options request.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/computer/packet_pairs.h"
#include "apps/computer/record.h"
#include "nodes/observers/activity_profile.h"
#include "nodes/observers/observer_group.h"
#include "nodes/observers/trace.h"
#include "nodes/ranks/clock_drift.h"
#include "svm/pages/observers/fetch_observer.h"
#include "svm/pages/observers/reference_log.h"
#include "svm/pages/run_tasks.h"
#include "svm/pages/task_heat.h"

namespace dmpc::apps {

/// The observed run; of tasks, if there are pages.
struct WatchedRun {
  std::uint32_t node_count = 1;
  std::uint32_t page_count = 0, task_count = 0;
};

/// For one run. Thread-safe as an Observer.
class ProgramObserver {
 public:
  ProgramObserver(const ProgramOptions& options, const Vocabulary& vocabulary, const WatchedRun& run);
  ProgramObserver(const ProgramObserver&) = delete;
  ProgramObserver& operator=(const ProgramObserver&) = delete;

  /// Returns the run's observer, or nullptr if there is none. Call it once.
  nodes::Observer* observer() { return members_.empty() ? nullptr : &group_.emplace(members_); }
  /// Reports a run of tasks to the observers (nullptr if absent) on every rank. Observations of ranks are added up.
  svm::TaskWatching watching();

  /// Serializes the observations of local nodes, for add() on rank 0.
  std::string seen() const;
  /// Adds the observations of another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);
  /// Replaces the record's observations of an earlier run. Call it once, after the run.
  void take(ProgramRecord& record);

 private:
  /// Creates an observer.
  template <class Watch, class... Arguments>
  void look_on(std::optional<Watch>& observer, Arguments&&... arguments);
  void watch_pages(const ProgramOptions& options, const WatchedRun& run);

  std::optional<nodes::TraceRecorder> recorder_;
  std::optional<nodes::ActivityProfile> profile_;
  std::optional<PairObserver> pairs_;          ///< only for a program with packets
  std::optional<svm::FetchObserver> fetches_;  ///< only for a program of tasks, as the members below
  std::vector<svm::ReferenceLog> reference_logs_;
  svm::TaskHeat heat_;
  std::vector<nodes::Observer*> members_;
  std::optional<nodes::ObserverGroup> group_;
};

}  // namespace dmpc::apps
