// Equal slots of plain bytes that any thread may take and only the receiver gives back: a stack of free slots with a tagged head.
//
// Thread safety: take() from any thread; give() from the one receiver, for a slot that nobody else holds.
//
// Invariants
// (1) A slot is free (on the stack) or held by exactly one thread or mailbox.
// (2) The link of a slot is meaningful to the one who holds it, or while it is free. It is atomic because a slow take() may still
//     read it when the slot has gone to another; such a take() then fails, because the head has changed. A link of 0 has never
//     been written: after that slot comes the one with the next number. So making a pool touches neither links nor slots, and the
//     real computer commits nothing for slots that are never taken.
// (3) The head's tag grows by 1 with every take, so a head that looks the same is the same (no ABA). The tag has 32 bits: wrong
//     only if exactly a multiple of 2^32 takes happen while one take() is suspended between its load and its compare-exchange and
//     the same slot is on top again.
// Progress: lock-free. A take() or give() repeats only because another one has succeeded meanwhile; a thread stopped
// half-way has either not changed the head yet or is done, so nobody waits for it. At worst it keeps one slot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/atomics.h"

namespace dmpc::nodes {

/// The name of a slot among all slots of a mailbox.
using SlotIndex = std::uint32_t;
inline constexpr SlotIndex no_slot = 0xFFFFFFFF;

template <class Atomics>
class BasicSlotPool {
 public:
  template <class T>
  using Atomic = typename Atomics::template Atomic<T>;

  /// The head of the stack of free slots: index below, tag above.
  struct alignas(cache_line_bytes) Head {
    Atomic<std::uint64_t> word{no_slot};
  };

  /// Owns the slots first .. first + bytes.size() / stride_bytes - 1, all free. `links` has an entry for every slot of the
  /// mailbox, and those of these slots are 0. The caller's memory must outlive the pool. To be called before any other thread
  /// knows the pool.
  BasicSlotPool(Head& head, std::span<Atomic<SlotIndex>> links, SlotIndex first, std::span<std::byte> bytes,
                std::size_t stride_bytes)
      : head_(&head),
        links_(links),
        bytes_(bytes),
        stride_bytes_(stride_bytes),
        first_(first),
        end_(first + static_cast<SlotIndex>(bytes.size() / stride_bytes)) {
    if (first_ < end_) {
      head.word.store(with_index(head.word.load(std::memory_order_relaxed), first_), std::memory_order_relaxed);
    }
  }

  /// A free slot, now the caller's, or no_slot.
  [[nodiscard]] SlotIndex take() {
    while (true) {
      std::uint64_t head = head_->word.load(std::memory_order_acquire);  // partner: the release in give()
      const SlotIndex slot = index_of_head(head);
      if (slot == no_slot) {
        return no_slot;
      }
      const SlotIndex next = behind(slot, links_[slot].load(std::memory_order_relaxed));
      // Relaxed: success proves that the head is the very one which the load has acquired.
      if (head_->word.compare_exchange_weak(head, after_take(head, next), std::memory_order_relaxed, std::memory_order_relaxed)) {
        return slot;
      }
    }
  }

  /// Frees a slot that the caller holds and has finished reading.
  void give(SlotIndex slot) {
    std::uint64_t head = head_->word.load(std::memory_order_relaxed);
    do {
      links_[slot].store(index_of_head(head) + link_offset, std::memory_order_relaxed);
      // Release: the recipient's acquire sees the link, and writes only after our reads.
    } while (
        !head_->word.compare_exchange_weak(head, with_index(head, slot), std::memory_order_release, std::memory_order_relaxed));
  }

  /// The bytes of a slot that the caller holds.
  std::span<std::byte> slot(SlotIndex index) const { return bytes_.subspan((index - first_) * stride_bytes_, stride_bytes_); }

 private:
  /// Added to a link of the stack, modulo 2^32: that of a slot is 2 or more, that of none 1.
  static constexpr SlotIndex link_offset = 2;

  /// The free slot after `slot`, whose link this is; arbitrary if another thread has taken it meanwhile.
  SlotIndex behind(SlotIndex slot, SlotIndex link) const {
    return link != 0 ? link - link_offset : slot + 1 < end_ ? slot + 1 : no_slot;
  }
  static SlotIndex index_of_head(std::uint64_t head) { return static_cast<SlotIndex>(head); }
  static std::uint64_t with_index(std::uint64_t head, SlotIndex slot) { return (head >> 32U << 32U) | slot; }
  static std::uint64_t after_take(std::uint64_t head, SlotIndex next) {
    return with_index(head + (std::uint64_t{1} << 32U), next);
  }

  Head* head_;
  std::span<Atomic<SlotIndex>> links_;
  std::span<std::byte> bytes_;
  std::size_t stride_bytes_;
  SlotIndex first_, end_;
};

}  // namespace dmpc::nodes
