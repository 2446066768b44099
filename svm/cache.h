// Frames for pages of other homes, with exact least-recently-used replacement.
//
// Invariants: (1) a page is in at most one frame, and the table finds it there; (2) a frame without a page has stamp 0, which
// is older than every reference; (3) the candidates from next_candidate_ on are, as long as their stamps have not changed,
// the frames with the least stamps of all, in order: stamps only grow, so a frame that was not among the oldest cannot become
// older than one that was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/local_memory.h"
#include "svm/page.h"

namespace dmpc::svm {

/// LRU is kept as a time stamp a frame, so that a reference costs one store; the victim is sought when one is needed, and one
/// search yields the oldest few. The page's frame is found by a table with open addressing, at most half full. Everything
/// lies in the node's local memory. Thread safety: none; belongs to one node.
class Cache {
 public:
  /// `frame_count` 0 makes a cache that never finds anything and takes no page.
  Cache(nodes::LocalMemory& memory, std::uint32_t frame_count, std::size_t page_size_bytes);
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, std::uint32_t frame_count, std::size_t page_size_bytes);

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
  /// The first byte of a frame.
  const std::byte* bytes_of(std::uint32_t frame) const { return frames_.data() + frame * page_size_bytes_; }

  /// Copies an absent page into the frame that was used least recently (one that is empty, if there is one) and makes it the
  /// most recently used. Returns the page that had to go, or no_page. Requires at least one frame and `bytes` of the page's
  /// size.
  PageId install(PageId page, std::span<const std::byte> bytes);

  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps_.size()); }

 private:
  struct Entry {
    PageId page = no_page;
    std::uint32_t frame = 0;
  };
  struct Candidate {
    std::uint64_t stamp = 0;
    std::uint32_t frame = 0;
    std::uint32_t padding = 0;
  };
  static constexpr std::uint32_t candidate_count_max = 64;

  static std::size_t table_size(std::uint32_t frame_count);
  static std::size_t candidate_capacity(std::uint32_t frame_count);

  std::size_t start_of(PageId page) const { return (index_of(page) * 0x9e3779b1U) >> hash_shift_; }
  std::size_t after(std::size_t place) const { return (place + 1) & (table_.size() - 1); }
  std::uint32_t least_recently_used();
  void seek_candidates();
  void insert(PageId page, std::uint32_t frame);
  void erase(PageId page);

  std::size_t page_size_bytes_;
  std::uint32_t hash_shift_;
  std::uint64_t clock_ = 0;
  std::span<std::byte> frames_;
  std::span<Entry> table_;
  std::span<std::uint64_t> stamps_;  ///< time of each frame's last reference
  std::span<PageId> pages_;          ///< the page in each frame
  std::span<Candidate> candidates_;  ///< the oldest frames at the last search, oldest first
  std::size_t candidate_count_ = 0, next_candidate_ = 0;
};

}  // namespace dmpc::svm
