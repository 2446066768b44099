// Who looks on at a render, as its options ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "apps/run/render_options.h"
#include "apps/run/run_view.h"
#include "nodes/watch/observer_group.h"
#include "nodes/watch/trace.h"
#include "svm/watch/reference_log.h"

namespace dmpc::apps {

/// What they have seen, as far as somebody wants to know it.
struct Sights {
  std::optional<nodes::Trace> trace;          ///< for --trace
  std::optional<RunView> view;                ///< for --report
  std::vector<svm::ReferenceLog> references;  ///< for --references, one a node
};

/// Instruments beside one run, whose memory is no node's. Thread safety: as an Observer; take() when the run is over.
class Onlookers {
 public:
  /// `page_count`: of the database. `references_max`: of all nodes together that are kept, about,
  /// unless a file is to have all.
  Onlookers(const RenderOptions& options, std::uint32_t page_count, std::size_t references_max = std::size_t{1} << 22U);
  Onlookers(const Onlookers&) = delete;
  Onlookers& operator=(const Onlookers&) = delete;

  /// For the run; nullptr if nobody looks on.
  nodes::Observer* observer() const { return observer_; }
  /// For the run; nullptr if nobody wants to know the references.
  std::vector<svm::ReferenceLog>* reference_logs() { return reference_logs_.empty() ? nullptr : &reference_logs_; }

  /// What was seen; call it once.
  Sights take();

 private:
  MissEstimate estimate_misses();

  std::unique_ptr<nodes::TraceRecorder> recorder_;
  std::unique_ptr<nodes::ActivityProfile> profile_;
  std::unique_ptr<svm::FetchWatch> fetches_;
  std::vector<svm::ReferenceLog> reference_logs_;
  bool keeps_references_ = false;
  std::optional<nodes::ObserverGroup> group_;
  nodes::Observer* observer_ = nullptr;
};

}  // namespace dmpc::apps
