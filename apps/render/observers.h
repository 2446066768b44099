// Observers of a render, or of a rank's part of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/run/run_view.h"
#include "apps/render/observer_order.h"
#include "nodes/observers/done_observer.h"
#include "nodes/observers/heat_map.h"
#include "nodes/observers/observer_group.h"
#include "nodes/observers/trace.h"
#include "nodes/observers/watching.h"
#include "nodes/ranks/clock_drift.h"
#include "svm/pages/observers/reference_log.h"

namespace dmpc::apps {

/// The observations that were asked for, except the heat map.
struct RunProfile {
  std::optional<nodes::Trace> trace;          ///< for --trace
  std::optional<RunView> view;                ///< for --report
  std::vector<svm::ReferenceLog> references;  ///< for --references, one log per node
};

/// Observers of one run, with memory outside the nodes. Thread safety: as an Observer; seen(), add() and take() after the run.
class Observers {
 public:
  /// `another` is an additional observer, if there is one, and outlives this.
  explicit Observers(const ObserverOrder& order, nodes::Observer* another = nullptr);
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  /// The observers for the run; absent ones are null pointers. With ranks, this is rank 0's, and the others get the same order.
  nodes::Watching watching();
  /// For the run; nullptr if references are not recorded.
  std::vector<svm::ReferenceLog>* reference_logs() { return reference_logs_.empty() ? nullptr : &reference_logs_; }

  /// All observations of this rank, for add() on rank 0.
  std::string seen() const;
  /// Adds the observations of another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);

  /// Begins another run, for heat maps alone: earlier observations are dropped.
  void begin_again();

  /// Nothing if it was not asked for.
  const nodes::HeatMap* heat() const { return heat_ ? &*heat_ : nullptr; }
  /// The other observations; to be called once.
  RunProfile take();

 private:
  template <class Self, class Visit>
  static void visit_shared(Self& self, const Visit& visit);

  ObserverOrder order_;
  std::optional<nodes::HeatMap> heat_;
  std::unique_ptr<nodes::TraceRecorder> recorder_;
  std::unique_ptr<nodes::DoneObserver> done_;
  std::unique_ptr<nodes::ActivityProfile> profile_;
  std::unique_ptr<nodes::WaitLog> waits_;
  std::optional<nodes::ExchangeProfile> exchange_;
  std::unique_ptr<svm::FetchObserver> fetches_;
  std::vector<svm::ReferenceLog> reference_logs_;
  std::optional<nodes::ObserverGroup> group_;
  nodes::Observer* observer_ = nullptr;
};

}  // namespace dmpc::apps
