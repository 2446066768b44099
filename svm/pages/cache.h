// Frames for pages of other homes, and the location of each page.
//
// Invariants: (1) a page is in at most one frame, and the table finds it there; (2) frames are filled in order, and no page is
// evicted before all are full; (3) the stamp of a frame with a page is above 0 unless the replacement policy has reset it.
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

/// The size of a cache.
struct CacheShape {
  std::uint32_t frame_count = 0;  ///< 0 makes a cache that never finds anything and takes no page
  std::size_t page_size_bytes = 0;
  Replacement replacement = Replacement::lru;
  OwnPolicyRun* own = nullptr;  ///< decides in place of `replacement`, whose memory stands for that of its state
};

/// A reference costs one store, and a call under policies with hears_hits. The victim is chosen when the page that needs its
/// frame arrives, not when it is requested: references in between count. Everything that grows with the number of frames lies in
/// the node's local memory. Not thread-safe; belongs to one node.
class Cache {
 public:
  /// `seed` is the node's number, for the policy random.
  Cache(nodes::LocalMemory& memory, const CacheShape& shape, std::uint32_t seed);
  /// The memory that the constructor takes.
  static nodes::MemoryPlan layout(const CacheShape& shape);

  static constexpr std::uint32_t no_frame = PageTable::nowhere;

  /// The frame that the page is in, or no_frame. It stays there until install() returns the page as evicted.
  std::uint32_t frame_of(PageId page) const { return table_.find(page); }
  /// Makes the page in `frame` the most recently used.
  void touch(std::uint32_t frame) {
    stamps_[frame] = ++clock_;
    if (hears_hits_) {
      report_of_hit(frame);
    }
  }
  /// The first byte of a frame's page.
  const std::byte* bytes_of(std::uint32_t frame) const { return frames_.at(frame); }

  /// Puts an absent page into an empty frame, or into that of the evicted page, and makes it the most recently used. Returns the
  /// evicted page, or no_page; or `page` itself if it bypasses the cache, which is then unchanged. Requires at least one frame
  /// and `bytes` of the page's size. A touch() that follows is not a further reference, but the one that requested the page.
  PageId install(PageId page, std::span<const std::byte> bytes);
  /// install() where `places` stores the frame of each page: to be used always, so that this cache's own table stays empty.
  PageId install(PageId page, std::span<const std::byte> bytes, PagesInPlace& places);
  /// Installs the page that lies at `offset_bytes` of `source`.
  PageId install(PageId page, const nodes::ByteSource& source, std::size_t offset_bytes);

  /// Number of frames that have a page.
  std::uint32_t filled_count() const { return filled_count_; }
  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps_.size()); }

 private:
  void report_of_hit(std::uint32_t frame);

  /// Returns the evicted page, which is removed from `places`. put(frame) stores the page's bytes.
  template <class Places, class Put>
  PageId install_by(PageId page, Places& places, const Put& put);

  bool hears_hits_;
  std::uint64_t clock_ = 0;
  nodes::ImmutablePieces frames_;
  PageTable table_;
  std::span<std::uint64_t> stamps_;      ///< time of each frame's last reference
  std::span<PageId> pages_;              ///< the page in each frame
  std::uint32_t filled_count_ = 0;       ///< number of frames that have a page: the first ones
  std::uint32_t last_frame_ = no_frame;  ///< the frame of the last page that was installed or reported as a hit
  std::unique_ptr<ReplacementPolicy> policy_;
};

}  // namespace dmpc::svm
