// Pages that have been requested, and the node's pixels that wait for each.
//
// Invariants: (1) a page has at most one fault, so at most one request is in flight for it, and there are never more faults than
// pages that live elsewhere; (2) a slot waits for at most one page, so there are never more faults than slots; (3) faults are in
// the order in which they arose.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

inline constexpr std::uint32_t no_slot = 0xffffffffU;

/// Not thread-safe; belongs to one node.
class Faults {
 public:
  struct Fault {
    PageId page = no_page;
    std::uint32_t home = 0;
    std::uint32_t first = no_slot, last = no_slot;  ///< the chain of waiting slots, in the order of their arrival
    bool requested = false;                         ///< false: the request was refused and waits for a credit
  };

  /// For slots 0 .. slot_count - 1, which wait for up to `faults_max` pages.
  Faults(nodes::LocalMemory& memory, std::uint32_t slot_count, std::uint32_t faults_max) {
    std::tie(faults_, next_) = layout(slot_count, faults_max).in(memory);
  }

  /// The memory that the constructor takes.
  static nodes::Layout<Fault, std::uint32_t> layout(std::uint32_t slot_count, std::uint32_t faults_max) {
    return {{nodes::Category::queues, faults_max}, {nodes::Category::queues, slot_count}};
  }

  /// Lets `slot` wait for `page`. Returns the new fault if no slot waited for that page before, otherwise nullptr.
  Fault* park(std::uint32_t slot, PageId page, std::uint32_t home) {
    next_[slot] = no_slot;
    if (Fault* fault = find(page)) {
      next_[fault->last] = slot;
      fault->last = slot;
      return nullptr;
    }
    core::expect(count_ < faults_.size(),
                 "there are never more faults than pixels in flight, nor than pages that live elsewhere");
    Fault& fault = faults_[count_++];
    fault = {page, home, slot, slot, false};
    return &fault;
  }

  /// Ends the fault of an arrived page; returns the first slot that waited for it. Expects that there is one, and that the page
  /// was requested.
  std::uint32_t arrived(PageId page) {
    Fault* fault = find(page);
    core::expect(fault != nullptr && fault->requested, "a page arrives only where it was asked for");
    const std::uint32_t first = fault->first;
    std::copy(fault + 1, faults_.data() + count_, fault);
    --count_;
    return first;
  }

  /// The slot that waits for the same page after `slot`, or no_slot. Read it before the slot runs: it may park again.
  std::uint32_t next(std::uint32_t slot) const { return next_[slot]; }
  /// The oldest fault at `home` whose request was refused, or nullptr.
  Fault* oldest_refused(std::uint32_t home) {
    for (Fault& fault : faults_.first(count_)) {
      if (!fault.requested && fault.home == home) {
        return &fault;
      }
    }
    return nullptr;
  }

  std::uint32_t count() const { return count_; }

 private:
  Fault* find(PageId page) {
    for (Fault& fault : faults_.first(count_)) {
      if (fault.page == page) {
        return &fault;
      }
    }
    return nullptr;
  }

  std::span<Fault> faults_;
  std::span<std::uint32_t> next_;
  std::uint32_t count_ = 0;
};

}  // namespace dmpc::svm
