// The page misses of a replacement policy, from the references alone, and the minimum for any policy that knows the future.
//
// Source: L. A. Belady, "A Study of Replacement Algorithms for a Virtual-Storage Computer" (1966): evict the page whose next
// reference is furthest away. Pages are fetched on demand, each into a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// Called with the number of each reference that misses, in order; may be empty.
using Missed = std::function<void(std::size_t reference)>;

/// The minimum of misses of one node's references. The first pass, which finds each reference's next, is in the constructor; the
/// second is done for each size. Thread safety: an immutable value once made.
class Optimum {
 public:
  /// Fewer than 2^32 - 1 references, which outlive this.
  explicit Optimum(std::span<const PageId> references);

  /// Page misses with `cache_pages` frames; with none every reference is one. Time n log c, memory p for n references of pages
  /// below p and c frames.
  std::uint64_t misses(std::uint32_t cache_pages, const Missed& missed = {}) const;

 private:
  std::span<const PageId> references_;
  std::uint32_t page_bound_;
  std::vector<std::uint32_t> next_;  ///< by time: the time of the page's next reference
};

/// The misses of a node's cache of `cache_pages` frames, if each page arrived before the next reference; with none every
/// reference is a miss. `seed` is the node's number. Takes a cache's memory, with pages of one byte, and for each reference about
/// a cache's time. Throws core::CapacityError if there is not enough memory.
std::uint64_t policy_misses(Replacement replacement, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed, const Missed& missed = {});
/// The same with a policy of the user's. A page that bypasses the cache serves its references in a row.
std::uint64_t policy_misses(OwnPolicyRun& policy, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed, const Missed& missed = {});

}  // namespace dmpc::svm
