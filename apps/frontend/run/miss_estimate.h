// Estimates how often pages would be missed with caches of other sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "svm/pages/observers/miss_curve.h"
#include "svm/pages/observers/reference_log.h"

namespace dmpc::apps {

/// About this many references of all nodes together are kept for an estimate.
inline constexpr std::size_t references_usual = std::size_t{1} << 22U;
/// Number of references to record per node, if all nodes together are to record about `references_max`.
std::size_t references_of_node(std::uint32_t node_count, std::size_t references_max = references_usual);

/// The miss curve of sampled references.
struct MissEstimate {
  svm::MissCurve curve;      ///< from the references of one page in `every`
  std::uint32_t every = 1;   ///< a power of two; 1: all pages
  svm::MissCurve half = {};  ///< from every second page of `curve`, for the sampling error; empty if every page counts
  /// The misses of all nodes together, each with a cache of `cache_pages` pages.
  double misses(std::uint32_t cache_pages) const;
  /// As misses(), from `half`.
  double half_misses(std::uint32_t cache_pages) const;
  /// The smallest cache for which the sample is meaningful: it holds some of the sample's pages.
  std::uint32_t cache_pages_min() const;
};

/// Estimates the misses of all nodes together, from the same share of each node's references: that of the smallest log; the other
/// logs are thinned out to it.
MissEstimate estimate_misses(std::vector<svm::ReferenceLog>& logs);

}  // namespace dmpc::apps
