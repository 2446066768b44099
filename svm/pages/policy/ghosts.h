// Names of evicted pages.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/picture/memory_use.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"
#include "svm/pages/page_table.h"
#include "svm/pages/policy/index_lists.h"

namespace dmpc::svm {

/// Up to a number of pages in two lists. In the node's local memory. Not thread-safe.
class Ghosts {
 public:
  static constexpr unsigned only_list = 0;  ///< for policies that need only one

  Ghosts(nodes::LocalMemory& memory, std::uint32_t capacity) : lists_(memory, capacity), table_(memory, capacity) {
    std::tie(pages_, free_) = own_layout(capacity).in(memory);
    for (; free_count_ < capacity; ++free_count_) {
      free_[free_count_] = free_count_;
    }
  }
  /// The memory that the constructor takes.
  static nodes::MemoryPlan layout(std::uint32_t capacity) {
    return IndexLists::layout(capacity) + PageTable::layout(capacity) + own_layout(capacity);
  }

  /// Removes a page; returns the list that it was in, if any.
  std::optional<unsigned> take(PageId page) {
    const std::uint32_t index = table_.find(page);
    if (index == PageTable::nowhere) {
      return std::nullopt;
    }
    const unsigned list = lists_.list_of(index);
    lists_.remove(index);
    release(index);
    return list;
  }
  /// Requires fewer than capacity pages, and that the page is none of them.
  void remember(unsigned list, PageId page) {
    core::expect(free_count_ > 0, "no more pages are remembered than there is room for");
    const std::uint32_t index = free_[--free_count_];
    pages_[index] = page;
    table_.insert(page, index);
    lists_.push(list, index);
  }
  /// Adds the page; if full, drops the one that has been in the list longest.
  void remember_latest(unsigned list, PageId page) {
    if (free_count_ == 0) {
      forget_oldest(list);
    }
    remember(list, page);
  }
  /// Drops the page that has been in the list longest; requires that there is one.
  void forget_oldest(unsigned list) { release(lists_.remove_oldest(list)); }
  std::uint32_t size(unsigned list) const { return lists_.size(list); }

 private:
  static nodes::Layout<PageId, std::uint32_t> own_layout(std::uint32_t capacity) {
    return {{core::MemoryUse::page_table, capacity}, {core::MemoryUse::page_table, capacity}};
  }
  void release(std::uint32_t index) {
    table_.erase(pages_[index]);
    free_[free_count_++] = index;
  }

  IndexLists lists_;
  PageTable table_;
  std::span<PageId> pages_;
  std::span<std::uint32_t> free_;
  std::uint32_t free_count_ = 0;
};

}  // namespace dmpc::svm
