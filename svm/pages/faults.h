// Pages that are on their way to a node, and which of its pixels wait for each.
//
// Invariants: (1) a page has at most one fault, so at most one request is under way for it, and there are never more faults than
// pages that live elsewhere; (2) a slot waits for at most one page, so there are never more faults than slots; (3) faults stand
// in the order in which they arose.
#pragma once

#include <cstdint>
#include <span>

#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

inline constexpr std::uint32_t no_slot = 0xffffffffU;

/// Thread safety: none; belongs to one node.
class Faults {
 public:
  struct Fault {
    PageId page = no_page;
    std::uint32_t home = 0;
    std::uint32_t first = no_slot, last = no_slot;  ///< the chain of waiting slots, in the order of their arrival
    bool requested = false;                         ///< false: the request was refused and waits for a credit
  };

  /// Room for slots 0 .. slot_count - 1, which wait for up to `faults_max` pages.
  Faults(nodes::LocalMemory& memory, std::uint32_t slot_count, std::uint32_t faults_max);
  /// What the constructor takes.
  static nodes::Layout<Fault, std::uint32_t> layout(std::uint32_t slot_count, std::uint32_t faults_max);

  /// `slot` waits for `page`. Returns the new fault if nobody waited for that page before, else nullptr.
  Fault* park(std::uint32_t slot, PageId page, std::uint32_t home);
  /// Ends the fault of an arrived page; returns the first of the slots that waited for it. Expects that there was one,
  /// requested.
  std::uint32_t arrived(PageId page);
  /// The slot that waits for the same page behind `slot`, or no_slot. Read it before the slot runs on: it may park again.
  std::uint32_t next(std::uint32_t slot) const { return next_[slot]; }
  /// The oldest fault at `home` whose request was refused, or nullptr.
  Fault* oldest_refused(std::uint32_t home);

  std::uint32_t count() const { return count_; }

 private:
  Fault* find(PageId page);

  std::span<Fault> faults_;
  std::span<std::uint32_t> next_;
  std::uint32_t count_ = 0;
};

}  // namespace dmpc::svm
