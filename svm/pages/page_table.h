// Maps a bounded number of pages to their places.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/memory_use.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// A hash table with open addressing, at most half full, so that a search ends soon. It lies in the node's local memory. Not
/// thread-safe; belongs to one node.
class PageTable {
  struct Entry;

 public:
  static constexpr std::uint32_t nowhere = 0xffffffffU;

  /// For up to `page_count` pages.
  PageTable(nodes::LocalMemory& memory, std::uint32_t page_count)
      : hash_shift_(32U - static_cast<std::uint32_t>(std::countr_zero(size_for(page_count)))),
        entries_(layout(page_count).in(memory)) {}
  /// The memory that the constructor takes.
  static nodes::Room<Entry> layout(std::uint32_t page_count) { return {core::MemoryUse::page_table, size_for(page_count)}; }

  /// nowhere if the page is not in the table.
  std::uint32_t find(PageId page) const {
    std::size_t at = start_of(page);
    while (entries_[at].page != page) {
      if (entries_[at].page == no_page) {
        return nowhere;
      }
      at = after(at);
    }
    return entries_[at].place;
  }
  /// Requires that the page is not in the table, and that the table is not full.
  void insert(PageId page, std::uint32_t place) {
    std::size_t at = start_of(page);
    while (entries_[at].page != no_page) {
      at = after(at);
    }
    entries_[at] = {page, place};
  }
  /// Removes a page that is in the table. Closes the gap by moving back every later entry of the run that may stand there, so
  /// that no search ends too early (D. E. Knuth, The Art of Computer Programming 3, section 6.4, algorithm R).
  void erase(PageId page) {
    const std::size_t mask = entries_.size() - 1;
    std::size_t gap = start_of(page);
    while (entries_[gap].page != page) {
      core::expect(entries_[gap].page != no_page, "the table finds every page that is in it");
      gap = after(gap);
    }
    for (std::size_t at = after(gap); entries_[at].page != no_page; at = after(at)) {
      const std::size_t distance_from_start = (at - start_of(entries_[at].page)) & mask;
      if (distance_from_start >= ((at - gap) & mask)) {
        entries_[gap] = entries_[at];
        gap = at;
      }
    }
    entries_[gap] = {};
  }

 private:
  struct Entry {
    PageId page = no_page;
    std::uint32_t place = 0;
  };

  /// At least 2, so that the shift of the hash stays below 32.
  static std::size_t size_for(std::uint32_t page_count) {
    return std::bit_ceil(std::max<std::size_t>(2 * std::size_t{page_count}, 2));
  }
  std::size_t start_of(PageId page) const { return (index_of(page) * 0x9e3779b1U) >> hash_shift_; }
  std::size_t after(std::size_t at) const { return (at + 1) & (entries_.size() - 1); }

  std::uint32_t hash_shift_;
  std::span<Entry> entries_;
};

}  // namespace dmpc::svm
