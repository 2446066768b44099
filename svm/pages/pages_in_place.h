// The places of pages where nodes refer to one database and share the real computer's caches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "nodes/byte_source.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"
#include "svm/pages/page_capacity.h"
#include "svm/pages/page_table.h"

namespace dmpc::svm {

/// Where pages lie in the one database, two bytes per page suffice: whether it is here, permanently or in which frame. With many
/// nodes that fits the real computer's caches, which tables of places and translations, and searches in them, do not. Outside of
/// the node's memory. Not thread-safe; belongs to one node.
class PagesInPlace {
 public:
  /// With more pages, or frames, the tables of hundreds of nodes would take the memory that they save.
  static constexpr std::uint32_t pages_max = 32768;

  /// Nothing if the memory copies immutable bytes, or if there are too many pages.
  static std::optional<PagesInPlace> of(const nodes::LocalMemory& memory, const PageCapacity& capacity,
                                        const nodes::ByteSource& database) {
    return memory.immutable() == nodes::Immutable::is_referred_to &&
                   std::max(capacity.page_count, capacity.cache.frame_count) <= pages_max
               ? std::optional(PagesInPlace(capacity, database))
               : std::nullopt;
  }

  static constexpr std::uint32_t absent = 0xffff, for_good = 0xfffe, passing = 0xfffd;

  /// The frame of a page, or for_good, absent, or passing, of one that has bypassed the frames.
  std::uint32_t frame_of(PageId page) const { return index_of(page) < count_ ? frames_[index_of(page)] : absent; }
  void put(PageId page, std::uint32_t frame) { frames_[index_of(page)] = static_cast<std::uint16_t>(frame); }

  // Interface of a cache's own table.
  std::uint32_t find(PageId page) const {
    const std::uint32_t frame = frame_of(page);
    return frame == absent ? PageTable::nowhere : frame;
  }
  void insert(PageId page, std::uint32_t frame) { put(page, frame); }
  void erase(PageId page) { put(page, absent); }

  /// The first byte of a page that is here.
  const std::byte* bytes_of(PageId page) const { return first_ + index_of(page) * page_size_bytes_; }

 private:
  PagesInPlace(const PageCapacity& capacity, const nodes::ByteSource& database)
      : count_(capacity.page_count),
        page_size_bytes_(capacity.page_size_bytes()),
        first_(database.immutable(0, database.size_bytes()).data()),
        frames_(std::make_unique<std::uint16_t[]>(count_)) {
    std::fill_n(frames_.get(), count_, static_cast<std::uint16_t>(absent));
  }

  std::uint32_t count_;
  std::size_t page_size_bytes_;
  const std::byte* first_;
  std::unique_ptr<std::uint16_t[]> frames_;
};

}  // namespace dmpc::svm
