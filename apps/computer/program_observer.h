// Who looks on at a run of a program, as far as its options ask for it.
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

/// What is looked on at: a run of tasks, if there are pages.
struct WatchedRun {
  std::uint32_t node_count = 1;
  std::uint32_t page_count = 0, task_count = 0;
};

/// For one run. Thread safety: as an Observer.
class ProgramObserver {
 public:
  ProgramObserver(const ProgramOptions& options, const Vocabulary& vocabulary, const WatchedRun& run);
  ProgramObserver(const ProgramObserver&) = delete;
  ProgramObserver& operator=(const ProgramObserver&) = delete;

  /// For the run; nullptr if nobody looks on. Call it once.
  nodes::Observer* observer() { return members_.empty() ? nullptr : &group_.emplace(members_); }
  /// Reports of a run of tasks to the observers, on every rank; absent observers have null pointers. What ranks saw is
  /// added up.
  svm::TaskWatching watching();

  /// What was seen of nodes that are here, for add() on rank 0.
  std::string seen() const;
  /// Takes over what was seen on another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);
  /// Puts what was seen into the record, in place of what another run showed. Call it once, when the run is over.
  void take(ProgramRecord& record);

 private:
  /// Makes a watch that looks on.
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
