// The pages of other homes that a node references, in order; an instrument outside of the computer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/expect.h"
#include "nodes/flat_bytes.h"
#include "svm/pages/page.h"
#include "svm/pages/share.h"

namespace dmpc::svm {

/// Repeats of the last page are left out: they are page hits in any cache and affect no replacement policy. Lies in memory that
/// is no node's. With a limit, references of ever fewer pages are kept, by sampling pages: a cache that is every() times smaller
/// behaves on them as the full one on all (C. A. Waldspurger, N. Park, A. Garthwaite, I. Ahmad, "Efficient MRC Construction with
/// SHARDS", 2015). A single page takes one entry, however often it is referenced, so a share that is small enough fits, and says
/// nothing about caches below some multiple of every() pages. If more than one page is in the least share, one of 2^31 pages,
/// what does not fit is dropped. Not thread-safe.
class ReferenceLog {
 public:
  /// Keeps all references.
  ReferenceLog() = default;
  /// Keeps up to `references_max` > 0.
  explicit ReferenceLog(std::size_t references_max) : references_max_(references_max) {}

  void note(PageId page) {
    if (page != last_) {
      last_ = page;
      keep(page);
    }
  }
  /// The references of the pages that are kept, in order.
  std::span<const PageId> pages() const { return pages_; }
  /// One page of every() is kept: a power of two.
  std::uint32_t every() const { return share_.every(); }
  /// Keeps one page of `every`, a power of two that is at least every().
  void thin_out(std::uint32_t every) {
    share_.shrink_to(every);
    std::erase_if(pages_, [this](PageId page) { return !share_.has(index_of(page)); });
    pages_.erase(std::unique(pages_.begin(), pages_.end()), pages_.end());
  }

  /// Serialises it for take() of another.
  void put(nodes::FlatWriter& flat) const {
    flat.put(share_.every());
    flat.put_all(pages_);
  }
  /// Replaces this, which is empty, by what another has kept.
  void take(nodes::FlatReader& flat) {
    share_.shrink_to(flat.take<std::uint32_t>());
    pages_ = flat.take_all<PageId>();
  }

 private:
  void keep(PageId page) {
    while (wants(page) && pages_.size() == references_max_ && !share_.is_least()) {
      thin_out(2 * share_.every());
    }
    if (wants(page) && pages_.size() < references_max_) {
      pages_.push_back(page);
    }
  }
  bool wants(PageId page) const { return share_.has(index_of(page)) && (pages_.empty() || pages_.back() != page); }

  PageId last_ = no_page;
  Share share_;
  std::size_t references_max_ = std::numeric_limits<std::size_t>::max();
  std::vector<PageId> pages_;
};

/// Serialises the logs of the nodes that are here, for take_logs() of another rank.
inline void put_logs(nodes::FlatWriter& flat, const std::vector<ReferenceLog>& logs) {
  for (const ReferenceLog& log : logs) {
    const bool is_here = !log.pages().empty();
    flat.put(is_here);
    if (is_here) {
      log.put(flat);
    }
  }
}
/// Reads as many logs.
inline void take_logs(nodes::FlatReader& flat, std::vector<ReferenceLog>& logs) {
  for (ReferenceLog& log : logs) {
    if (flat.take<bool>()) {
      core::expect(log.pages().empty(), "a node is on one rank");
      log.take(flat);
    }
  }
}

}  // namespace dmpc::svm
