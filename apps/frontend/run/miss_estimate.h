// How often pages would be missed with caches of other sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "svm/pages/observers/miss_curve.h"
#include "svm/pages/observers/reference_log.h"

namespace dmpc::apps {

/// About so many references are kept for an estimate, of all nodes together.
inline constexpr std::size_t references_usual = std::size_t{1} << 22U;
/// So many references of each node are kept, if all are to keep about `references_max`.
std::size_t references_of_node(std::uint32_t node_count, std::size_t references_max = references_usual);

/// The curve of a sample's references.
struct MissEstimate {
  svm::MissCurve curve;      ///< of the references of one page of `every`
  std::uint32_t every = 1;   ///< a power of two; 1: of all
  svm::MissCurve half = {};  ///< of one page in two of them, for the error of the sample; of none if every page counts
  /// The misses of all nodes together, each with a cache of so many pages.
  double misses(std::uint32_t cache_pages) const;
  /// The same from `half`.
  double half_misses(std::uint32_t cache_pages) const;
  /// The smallest cache of which the sample tells something: it has some of the sample's pages.
  std::uint32_t cache_pages_min() const;
};

/// Estimates those of all nodes together, from the same share of each node's references: that of the log that keeps least, to
/// which the others are thinned out.
MissEstimate estimate_misses(std::vector<svm::ReferenceLog>& logs);

}  // namespace dmpc::apps
