// Data of a run that are shown beyond its counters.
#pragma once

#include <optional>

#include "apps/frontend/run/miss_estimate.h"
#include "nodes/observers/activity_profile.h"
#include "nodes/observers/exchange_profile.h"
#include "nodes/observers/wait_log.h"
#include "svm/pages/observers/fetch_observer.h"

namespace dmpc::apps {

/// Recorded outside the nodes' memories.
struct RunView {
  nodes::ActivitySteps steps;
  std::optional<nodes::WaitRecord> waits;          ///< on modelled machines
  std::optional<nodes::ExchangeProfile> exchange;  ///< likewise
  std::optional<svm::Fetches> fetches;             ///< svm only
  std::optional<MissEstimate> misses;              ///< svm only, unless it counts different pages
};

}  // namespace dmpc::apps
