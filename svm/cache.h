// Frames for pages of other homes, and where each page is.
//
// Invariants: (1) a page is in at most one frame, and the table finds it there; (2) frames are filled in their order, and no page
// leaves before all are; (3) the stamp of a frame with a page is above 0 unless the replacement policy has reset it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/byte_source.h"
#include "nodes/lasting_pieces.h"
#include "nodes/local_memory.h"
#include "svm/page.h"
#include "svm/replacement.h"

namespace dmpc::svm {

/// What a cache is made from.
struct CacheShape {
  std::uint32_t frame_count = 0;  ///< 0 makes a cache that never finds anything and takes no page
  std::size_t page_size_bytes = 0;
  Replacement replacement = Replacement::lru;
};

/// A reference costs one store, whatever the replacement policy. The victim is chosen when the page that needs its frame
/// arrives, not when it is asked for: what is referenced in between counts. The page's frame is found by a table with open
/// addressing, at most half full. Everything lies in the node's local memory. Thread safety: none; belongs to one node.
class Cache {
 public:
  /// `seed` is the node's own number, for the policy random.
  Cache(nodes::LocalMemory& memory, const CacheShape& shape, std::uint32_t seed);
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, const CacheShape& shape);

  static constexpr std::uint32_t no_frame = 0xffffffffU;

  /// The frame that the page is in, or no_frame. It stays there until install() returns the page as evicted.
  std::uint32_t frame_of(PageId page) const {
    std::size_t place = start_of(page);
    while (table_[place].page != page) {
      if (table_[place].page == no_page) {
        return no_frame;
      }
      place = after(place);
    }
    return table_[place].frame;
  }
  /// The page in `frame` is now the most recently used.
  void touch(std::uint32_t frame) { stamps_[frame] = ++clock_; }
  /// The first byte of a frame's page.
  const std::byte* bytes_of(std::uint32_t frame) const { return frames_.at(frame); }

  /// Puts an absent page into an empty frame, if there is one, or else into that of the page that has to go, and makes it the
  /// most recently used. Returns the page that had to go, or no_page. Requires at least one frame and `bytes` of the page's
  /// size.
  PageId install(PageId page, std::span<const std::byte> bytes);
  /// The same with the page that lies at `offset_bytes` of `source`.
  PageId install(PageId page, const nodes::ByteSource& source, std::size_t offset_bytes);

  /// Frames that have a page.
  std::uint32_t filled_count() const { return filled_count_; }
  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps_.size()); }

 private:
  struct Entry {
    PageId page = no_page;
    std::uint32_t frame = 0;
  };

  static std::size_t table_size(std::uint32_t frame_count);

  std::size_t start_of(PageId page) const { return (index_of(page) * 0x9e3779b1U) >> hash_shift_; }
  std::size_t after(std::size_t place) const { return (place + 1) & (table_.size() - 1); }
  /// Returns the page that had to go. put(frame) puts the page's bytes there.
  template <class Put>
  PageId install_by(PageId page, const Put& put);
  void insert(PageId page, std::uint32_t frame);
  void erase(PageId page);

  std::uint32_t hash_shift_;
  std::uint64_t clock_ = 0;
  nodes::LastingPieces frames_;
  std::span<Entry> table_;
  std::span<std::uint64_t> stamps_;  ///< time of each frame's last reference
  std::span<PageId> pages_;          ///< the page in each frame
  std::uint32_t filled_count_ = 0;   ///< frames that have a page: the first ones
  VictimChoice victims_;
};

}  // namespace dmpc::svm
