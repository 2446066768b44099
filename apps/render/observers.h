// Who looks on at a render, or at a rank's part of it.
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
  std::vector<svm::ReferenceLog> references;  ///< for --references, one a node
};

/// Instruments beside one run, whose memory is no node's. Thread safety: as an Observer; seen(), add() and take() when the run is
/// over.
class Observers {
 public:
  /// `another` looks on, too, if there is one, and outlives this.
  explicit Observers(const ObserverOrder& order, nodes::Observer* another = nullptr);
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  /// For the run, where nobody has a pointer who wants to know nothing. On ranks, on rank 0, others are given the same order.
  nodes::Watching watching();
  /// For the run; nullptr if nobody wants to know the references.
  std::vector<svm::ReferenceLog>* reference_logs() { return reference_logs_.empty() ? nullptr : &reference_logs_; }

  /// All that was seen here, for add() of rank 0's.
  std::string seen() const;
  /// Adds what was seen on another rank.
  void add(std::string_view seen, const nodes::ClockDrift& clock);

  /// Another run begins, for heat maps alone: what was seen is forgotten.
  void begin_again();

  /// Nothing if nobody wants to know it.
  const nodes::HeatMap* heat() const { return heat_ ? &*heat_ : nullptr; }
  /// What else was seen; call it once.
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
