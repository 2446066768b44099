// The pages of a node with moving regions: those that its units need at the start, and those that come with units.
//
// Pages are the whole database's, with its numbers, so an address means the same on every node: a hit that was found on one node
// is shaded there even if its unit has migrated. For the same reason no page is ever dropped. What a unit's rays need and what a
// node has is found by scanning the records (core/database/region_records.h), without lists.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/database/region_records.h"
#include "core/picture/memory_use.h"
#include "core/record/records.h"
#include "nodes/byte_source.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"

namespace dmpc::dataflow {

/// The numbers, ascending, of the pages that rays in `regions` and shading their hits may need: materials and lights, too.
std::vector<std::uint32_t> pages_of(const core::Database& database, std::span<const core::Region> regions);

/// Frames, and the frame of each page. Thread safety: belongs to one node.
class UnitPages {
 public:
  struct Capacity {
    std::size_t page_bytes = 0;  ///< 0: regions do not move, no pages
    std::uint32_t frames = 0;
  };

  UnitPages(nodes::LocalMemory& memory, const Capacity& capacity) : page_bytes_(capacity.page_bytes) {
    std::tie(bytes_, page_, slot_, marks_) = layout(capacity).in(memory);
  }
  /// The memory that the constructor takes.
  static nodes::Layout<std::byte, std::uint32_t, std::uint32_t, std::uint64_t> layout(const Capacity& capacity) {
    return {{core::MemoryUse::home_pages, frame_bytes(capacity)},
            {core::MemoryUse::page_table, capacity.frames},
            {core::MemoryUse::page_table, slots_of(capacity)},
            {core::MemoryUse::page_table, core::ceil_divide<std::size_t>(capacity.frames, 64)}};
  }

  std::size_t page_bytes() const { return page_bytes_; }
  std::uint32_t page_count() const { return count_; }
  std::uint32_t free_frames() const { return static_cast<std::uint32_t>(page_.size()) - count_; }

  /// Adds the pages with these numbers, whose bytes are consecutive in `records`. Call it before add().
  void begin_with(std::span<const std::uint32_t> pages, const nodes::ByteSource& records);
  /// Adds a page, for which it requires a free frame, unless it is here. Returns whether it did.
  [[nodiscard]] bool add(std::uint32_t page, std::span<const std::byte> bytes);
  /// The page's first byte; nullptr if it is not here.
  const std::byte* find_page(std::uint32_t page) const {
    const std::uint32_t frame = slot_.empty() ? 0 : slot_[place_of(page)];
    return frame == 0 ? nullptr : bytes_.data() + (frame - 1) * page_bytes_;
  }
  /// The record's first byte. A record that is not here cannot be hit by a unit's rays: returns an empty one.
  const std::byte* find(core::Address address) const {
    const std::uint64_t offset = core::byte_offset(address);
    const std::byte* const page = find_page(static_cast<std::uint32_t>(offset / page_bytes_));
    return page == nullptr ? nothing.data() : page + offset % page_bytes_;
  }

  struct Marked {
    std::uint32_t pages = 0;
    std::uint64_t records = 0;  ///< number of records that were read to find them
  };
  /// Marks the pages that rays in `region` need, all of which are here.
  Marked mark(const core::DatabaseHeader& header, const core::Region& region);
  /// The frame of the first page from frame `from` on that is marked. Requires that there is one.
  std::uint32_t next_marked(std::uint32_t from) const;
  std::uint32_t page_at(std::uint32_t frame) const { return page_[frame]; }
  std::span<const std::byte> bytes_at(std::uint32_t frame) const { return bytes_.subspan(frame * page_bytes_, page_bytes_); }

 private:
  /// A BVH node without children, a leaf without primitives.
  alignas(core::record_alignment) static const std::array<std::byte, core::record_bytes_max + core::overread_bytes> nothing;

  static std::size_t frame_bytes(const Capacity& capacity) {
    return capacity.frames == 0 ? 0 : capacity.frames * capacity.page_bytes + core::overread_bytes;
  }
  /// At most half of them are used, so that a search is short.
  static std::size_t slots_of(const Capacity& capacity) {
    return capacity.frames == 0 ? 0 : std::bit_ceil(std::size_t{capacity.frames} * 2);
  }
  /// The slot of a page, or where it would be: linear probing (Knuth, The Art of Computer Programming, 6.4), by multiplication.
  std::size_t place_of(std::uint32_t page) const {
    std::size_t place = (page * std::uint64_t{0x9e3779b97f4a7c15} >> 32) & (slot_.size() - 1);
    while (slot_[place] != 0 && page_[slot_[place] - 1] != page) {
      place = (place + 1) & (slot_.size() - 1);
    }
    return place;
  }

  void enter(std::uint32_t page);

  std::size_t page_bytes_;
  std::span<std::byte> bytes_;
  std::span<std::uint32_t> page_;   ///< by frame
  std::span<std::uint32_t> slot_;   ///< frame + 1, or 0
  std::span<std::uint64_t> marks_;  ///< a bit a frame
  std::uint32_t count_ = 0;
};

/// A node's records: its part of the database in one piece, or pages.
class PartRecords {
 public:
  /// `pages`, if there are any, outlive this.
  PartRecords(std::span<const std::byte> part, const UnitPages* pages) : part_(part.data()), pages_(pages) {}
  const std::byte* find(core::Address address) const {
    return pages_ == nullptr ? part_ + core::byte_offset(address) : pages_->find(address);
  }

 private:
  const std::byte* part_;
  const UnitPages* pages_;
};
static_assert(core::Records<PartRecords>);

}  // namespace dmpc::dataflow
