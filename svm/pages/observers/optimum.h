// The page misses of a replacement policy, from the references alone, and the fewest that any could have made, had it known the
// future.
//
// Source: L. A. Belady, "A Study of Replacement Algorithms for a Virtual-Storage Computer" (1966): the page that leaves is the
// one whose next reference is furthest away. Pages come on demand, each into a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

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

/// What a node's cache of `cache_pages` frames would miss, if each page came before the next reference; with none every reference
/// is a miss. `seed` is the node's number. Takes a cache's memory, its pages of one byte, and for each reference about what a
/// cache takes. Throws core::CapacityError if there is not so much.
std::uint64_t policy_misses(Replacement replacement, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed);

}  // namespace dmpc::svm
