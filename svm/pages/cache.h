// Frames for pages of other homes, and where each page is.
//
// Invariants: (1) a page is in at most one frame, and the table finds it there; (2) frames are filled in their order, and no page
// leaves before all are; (3) the stamp of a frame with a page is above 0 unless the replacement policy has reset it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "nodes/byte_source.h"
#include "nodes/immutable_pieces.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"
#include "svm/pages/page_table.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

class PagesInPlace;

/// What a cache is made from.
struct CacheShape {
  std::uint32_t frame_count = 0;  ///< 0 makes a cache that never finds anything and takes no page
  std::size_t page_size_bytes = 0;
  Replacement replacement = Replacement::lru;
};

/// A reference costs one store, and under policies that hear of hits a call. The victim is chosen when the page that needs its
/// frame arrives, not when it is asked for: what is referenced in between counts. All that grows with the number of frames lies
/// in the node's local memory. Thread safety: none; belongs to one node.
class Cache {
 public:
  /// `seed` is the node's own number, for the policy random.
  Cache(nodes::LocalMemory& memory, const CacheShape& shape, std::uint32_t seed);
  /// What the constructor takes.
  static nodes::MemoryPlan layout(const CacheShape& shape);

  static constexpr std::uint32_t no_frame = PageTable::nowhere;

  /// The frame that the page is in, or no_frame. It stays there until install() returns the page as evicted.
  std::uint32_t frame_of(PageId page) const { return table_.find(page); }
  /// The page in `frame` is now the most recently used.
  void touch(std::uint32_t frame) {
    stamps_[frame] = ++clock_;
    if (hears_hits_) {
      report_of_hit(frame);
    }
  }
  /// The first byte of a frame's page.
  const std::byte* bytes_of(std::uint32_t frame) const { return frames_.at(frame); }

  /// Puts an absent page into an empty frame, if there is one, or else into that of the page that has to go, and makes it the
  /// most recently used. Returns the page that had to go, or no_page. Requires at least one frame and `bytes` of the page's
  /// size. A touch() that follows is of the reference that it came for, no further one.
  PageId install(PageId page, std::span<const std::byte> bytes);
  /// The same where `places` says in which frame each page is: always, so that this cache's own table stays empty.
  PageId install(PageId page, std::span<const std::byte> bytes, PagesInPlace& places);
  /// Installs the page that lies at `offset_bytes` of `source`.
  PageId install(PageId page, const nodes::ByteSource& source, std::size_t offset_bytes);

  /// Frames that have a page.
  std::uint32_t filled_count() const { return filled_count_; }
  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps_.size()); }

 private:
  void report_of_hit(std::uint32_t frame);

  /// Returns the page that had to go, which `places` no longer finds. put(frame) puts the page's bytes there.
  template <class Places, class Put>
  PageId install_by(PageId page, Places& places, const Put& put);

  bool hears_hits_;
  std::uint64_t clock_ = 0;
  nodes::ImmutablePieces frames_;
  PageTable table_;
  std::span<std::uint64_t> stamps_;      ///< time of each frame's last reference
  std::span<PageId> pages_;              ///< the page in each frame
  std::uint32_t filled_count_ = 0;       ///< frames that have a page: the first ones
  std::uint32_t last_frame_ = no_frame;  ///< whose page came or was told of as a hit last
  std::unique_ptr<ReplacementPolicy> policy_;
};

}  // namespace dmpc::svm
