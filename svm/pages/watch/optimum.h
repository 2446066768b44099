// The fewest page misses that any replacement policy could have made, had it known the future.
//
// Source: L. A. Belady, "A Study of Replacement Algorithms for a Virtual-Storage Computer" (1966): the page that leaves is the
// one whose next reference is furthest away. Pages come on demand, each into a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "svm/pages/page.h"

namespace dmpc::svm {

/// The fewest misses of one node's references. The first pass, which finds each reference's next, is the constructor's; the
/// second is each size's. Thread safety: an immutable value once made.
class Optimum {
 public:
  /// Fewer than 2^32 - 1 references, which outlive this.
  explicit Optimum(std::span<const PageId> references);

  /// Page misses with `cache_pages` frames; with none every reference is one. Time n log c, memory p for n references of pages
  /// below p and c frames.
  std::uint64_t misses(std::uint32_t cache_pages) const;

 private:
  std::span<const PageId> references_;
  std::uint32_t page_bound_;
  std::vector<std::uint32_t> next_;  ///< by time: when the page is referenced again
};

}  // namespace dmpc::svm
