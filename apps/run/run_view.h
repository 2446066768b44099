// What is shown of a run beyond its counters.
#pragma once

#include <optional>

#include "nodes/watch/activity_profile.h"
#include "svm/watch/fetch_watch.h"
#include "svm/watch/miss_curve.h"

namespace dmpc::apps {

/// How often pages would be missed with other caches: the curve of a sample's references.
struct MissEstimate {
  svm::MissCurve curve;     ///< of the references of one page of `every`
  std::uint32_t every = 1;  ///< a power of two; 1: of all
  /// Of all nodes together, each with a cache of so many pages.
  double misses(std::uint32_t cache_pages) const;
};

/// All of it is kept outside the nodes' memories.
struct RunView {
  nodes::ActivitySteps steps;
  std::optional<svm::Fetches> fetches;  ///< of svm
  std::optional<MissEstimate> misses;   ///< of svm, unless it counts different pages
};

}  // namespace dmpc::apps
