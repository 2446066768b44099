// The page misses of an LRU cache of every size at once, from the references of one run.
//
// Source: R. L. Mattson, J. Gecsei, D. R. Slutz, I. L. Traiger, "Evaluation Techniques for Storage Hierarchies" (1970). A
// reference's stack distance is the number of distinct pages referenced since the last reference of its page; in an LRU cache
// with more frames than that it is a page hit, in any other a miss. So one histogram has the misses for every size. It is exact
// if the references do not depend on the cache.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "svm/pages/page.h"

namespace dmpc::svm {

/// A value: for one node, or the sum over several, each with its own cache.
class MissCurve {
 public:
  /// The curve of no references.
  MissCurve() = default;
  /// The curve of one node's references of pages that need a frame. Time n log p and memory 16 p for n references of pages below
  /// p (a Fenwick tree over the times of last references: B. T. Bennett, V. J. Kruskal, "LRU Stack Processing", 1975, with the
  /// tree of P. M. Fenwick, 1994).
  explicit MissCurve(std::span<const PageId> references);

  MissCurve& operator+=(const MissCurve& more);

  std::uint64_t references() const { return references_; }
  /// First references, which miss in any cache.
  std::uint64_t cold_misses() const { return cold_misses_; }
  /// Page misses with `cache_pages` frames; with none every reference is one.
  std::uint64_t misses(std::uint32_t cache_pages) const;
  /// The fewest frames with which there are only cold misses, 0 if there are no references. A cache that holds all distinct pages
  /// of a node's references never evicts one.
  std::uint32_t sufficient_pages() const { return static_cast<std::uint32_t>(at_distance_.size()); }
  /// The largest number of distinct pages of a node.
  std::uint32_t distinct_pages() const { return distinct_pages_; }

 private:
  std::uint64_t references_ = 0;
  std::uint64_t cold_misses_ = 0;
  std::uint32_t distinct_pages_ = 0;
  std::vector<std::uint64_t> at_distance_;  ///< references by stack distance
};

}  // namespace dmpc::svm
