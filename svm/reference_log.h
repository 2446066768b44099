// The pages of other homes that a node references, in order: an instrument, not a part of the computer.
#pragma once

#include <span>
#include <vector>

#include "svm/page.h"

namespace dmpc::svm {

/// Repeats of the page noted last are left out: they are page hits in any cache and change no replacement policy's mind. Grows as
/// needed, in memory that is no node's. Thread safety: none.
class ReferenceLog {
 public:
  void note(PageId page) {
    if (page != last_) {
      pages_.push_back(page);
      last_ = page;
    }
  }
  std::span<const PageId> pages() const { return pages_; }

 private:
  PageId last_ = no_page;
  std::vector<PageId> pages_;
};

}  // namespace dmpc::svm
