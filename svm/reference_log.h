// The pages of other homes that a node references, in order: an instrument, not a part of the computer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/sampling.h"
#include "svm/page.h"

namespace dmpc::svm {

/// Repeats of the page noted last are left out: they are page hits in any cache and change no replacement policy's mind. Lies in
/// memory that is no node's. With a bound, references of ever fewer pages are kept, those of one page of every(), chosen by a
/// hash of its number: what a cache would do with them is what it would do with all of them, every() times smaller (C. A.
/// Waldspurger, N. Park, A. Garthwaite, I. Ahmad, "Efficient MRC Construction with SHARDS", 2015). Thread safety: none.
class ReferenceLog {
 public:
  /// Keeps all.
  ReferenceLog() = default;
  /// Keeps up to `references_max` > 0.
  explicit ReferenceLog(std::size_t references_max) : references_max_(references_max) {}

  void note(PageId page) {
    if (page != last_) {
      last_ = page;
      keep(page);
    }
  }
  /// Of the pages that are kept, in order.
  std::span<const PageId> pages() const { return pages_; }
  /// A power of two.
  std::uint32_t every() const { return every_; }
  /// Keeps those of one page of `every`, a power of two that is at least every().
  void thin_out(std::uint32_t every) {
    every_ = every;
    std::erase_if(pages_, [this](PageId page) { return !is_chosen(page); });
  }

 private:
  bool is_chosen(PageId page) const { return (core::mix(index_of(page)) & (every_ - 1)) == 0; }
  void keep(PageId page) {
    if (is_chosen(page)) {
      pages_.push_back(page);
      while (pages_.size() > references_max_) {
        thin_out(2 * every_);
      }
    }
  }

  PageId last_ = no_page;
  std::uint32_t every_ = 1;
  std::size_t references_max_ = std::numeric_limits<std::size_t>::max();
  std::vector<PageId> pages_;
};

}  // namespace dmpc::svm
