// A node's bounded inbox: many senders, one receiver, two classes of slots, and the word on which the receiver sleeps.
//
// A packet is copied into a slot of its class (slot_pool.h) and the slot's index is put on the inbox, a stack of
// slots whose head is one word. The receiver takes the whole stack at once and turns it round, so packets come out in
// the order in which they went in; in particular the order of each sender is kept.
//
// Thread safety: push() and rouse() from any thread, the receiver's own included; everything else from the one
// receiver.
//
// Progress: push() is lock-free: its three loops (take a slot, put it on the inbox, and the receiver's give in between) repeat
// only because another thread has succeeded. Nobody can stall another thread for ever. A sender stopped before its packet is on
// the inbox is invisible to all; it keeps one slot, which its credit has paid for. One stopped after that is done, but may owe a
// wake-up to a sleeping receiver: no order of the two steps avoids that, as the system wakes only a thread that sleeps on a word
// that has changed. So a sleeper polls at times, and finds the packet: a missing wake-up makes it sleep as long again as it has
// slept, at least 16 ms and at most a second. A receiver stopped half-way keeps what it took; senders go on while they have
// credits. drain() is wait-free except for give(), which is lock-free.
//
// Invariants
// (1) The inbox word is EMPTY, ASLEEP, or the index of the slot pushed last. Only the receiver writes ASLEEP, and only over
//     EMPTY; whoever else replaces ASLEEP wakes the receiver. It is one word with one order of changes, so no wake-up is lost and
//     no fence is needed.
// (2) Every change of the inbox word is a read-modify-write, so the release of each push and rouse reaches the receiver's next
//     acquire, whatever came between.
// (3) A slot is on the free list, with one sender, on the inbox, or with the receiver. The receiver gives a slot back as soon as
//     its packet has been received, before it receives the next: at most one slot is held beyond those that credits account for.
//     That is the one spare slot a class has above its capacity.
//     A batch's slots are with its sender, chained as the inbox will have them, newest to oldest; handing them over is one
//     publication of all, so everything that holds for one packet holds for a batch.
// (4) The data changed by senders of small, senders of bulk and sleepers lies on different cache lines: the inbox, the two heads,
//     the links of the two classes, the slots. The links of 16 slots of one class share a line.
// (5) A receiver with a WakeUp has no thread of its own: the thread that replaces ASLEEP rings it, once, where otherwise the
//     system would wake the receiver and the count be raised. The one who is rung does that (threads/awake_nodes.h). wait() is
//     not called.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "nodes/atomics.h"
#include "nodes/awake_count.h"
#include "nodes/local_memory.h"
#include "nodes/packet.h"
#include "nodes/slot_pool.h"

namespace dmpc::nodes {

/// Notifies a receiver that shares its thread with others that it is no longer asleep.
class WakeUp {
 public:
  /// Never blocks. Called by the thread that has replaced ASLEEP, which is counted itself.
  virtual void ring() = 0;

 protected:
  ~WakeUp() = default;
};

/// The size of a node's mailbox, derived by the strategy from how many packets may be in flight.
struct MailboxCapacity {
  std::uint32_t small_slots = 0;
  std::uint32_t bulk_slots = 0;
  std::size_t bulk_payload_bytes = 0;  ///< the largest payload; at least what the small class holds if bulk_slots > 0
  std::size_t small_front_bytes = 0;   ///< that the small class holds in addition to small_payload_bytes: for push() with a front

  /// The local memory that such a mailbox takes (Category::mailbox).
  std::size_t bytes() const;
};

template <class Atomics>
class BasicMailbox {
 public:
  /// Empty and awake; takes all its memory from `memory` (Category::mailbox, exactly bytes(capacity)).
  BasicMailbox(const MailboxCapacity& capacity, LocalMemory& memory)
      : small_slots_(slot_count(capacity.small_slots)),
        small_payload_bytes_(small_payload_bytes + capacity.small_front_bytes),
        bulk_payload_bytes_(capacity.bulk_slots == 0 ? 0 : capacity.bulk_payload_bytes),
        inbox_(&memory.allocate<Inbox>(Category::mailbox, 1).front().word),
        links_(memory.allocate<Atomic<SlotIndex>>(Category::mailbox, link_count(capacity))),
        small_(make_pool(memory, 0, capacity.small_slots, small_stride_bytes(capacity))),
        bulk_(make_pool(memory, first_bulk(capacity), capacity.bulk_slots, bulk_slot_bytes(capacity))) {}

  /// Makes the mailbox ring `wake_up`, which outlives its use, in place of waking a thread. To be called before another thread
  /// knows it.
  void set_wake_up(WakeUp& wake_up) { wake_up_ = &wake_up; }

  /// Packets of one sender that lie in slots and are not yet visible to the receiver. Belongs to its sender, who hands it over.
  class Batch {
   public:
    bool is_empty() const { return newest_ == empty; }

   private:
    friend class BasicMailbox;
    SlotIndex oldest_ = empty, newest_ = empty;
  };

  /// Copies the packet in, wakes the receiver if it sleeps, and returns true; false if the class has no free slot (then nothing
  /// has happened). A payload of at most small_payload_bytes takes a small slot, a longer one a bulk slot; expects that it fits.
  /// `awake` counts the receiver; the caller is counted itself. The packet is `front` followed by `payload`.
  [[nodiscard]] bool push(const PacketHeader& header, std::span<const std::byte> payload, BasicAwakeCount<Atomics>& awake,
                          std::span<const std::byte> front = {}) {
    Batch batch;
    if (!add(batch, header, payload, front)) {
      return false;
    }
    hand_over(batch, awake);
    return true;
  }

  /// Copies the packet in, after those of the batch; returns and expects as push().
  [[nodiscard]] bool add(Batch& batch, const PacketHeader& header, std::span<const std::byte> payload,
                         std::span<const std::byte> front = {}) {
    core::expect(header.bytes == front.size() + payload.size(), "a header says how long its payload is");
    return put(batch, header, front, payload);
  }

  /// As add(), for a payload of `front` and `immutable`, bytes that never change and outlive the mailbox: the slot, which is the
  /// one that they would take, gets the address of `immutable` (at least 16 bytes).
  [[nodiscard]] bool add_in_place(Batch& batch, PacketHeader header, std::span<const std::byte> front,
                                  std::span<const std::byte> immutable) {
    core::expect(header.bytes == front.size() + immutable.size(), "a header says how long its payload is");
    core::expect(immutable.size() >= sizeof(immutable), "an immutable end is no shorter than its address");
    header.end_in_place = 1;
    return put(batch, header, std::as_bytes(std::span(&immutable, 1)), front);
  }

  /// Gives all packets of the batch to the receiver, in their order, and wakes it if it sleeps. `awake` as push()'s.
  void hand_over(Batch& batch, BasicAwakeCount<Atomics>& awake) {
    if (batch.is_empty()) {
      return;
    }
    SlotIndex head = inbox_->load(std::memory_order_relaxed);
    while (!try_publish(batch, head, awake)) {
    }
    batch = {};
  }

  /// Takes all packets at once and calls receive(packet) for each, oldest first; returns their number. Packets that arrive
  /// meanwhile stay for the next call. The payload is valid only during its call.
  template <class Receive>
  std::size_t drain(Receive&& receive) {
    if (is_empty()) {
      return 0;
    }
    // Acquire: partner of the release of every push whose packet is taken.
    SlotIndex slot = turned_round(inbox_->exchange(empty, std::memory_order_acquire));
    std::size_t count = 0;
    for (; slot != empty; ++count) {
      const SlotIndex next = links_[slot].load(std::memory_order_relaxed);
      Pool& pool = pool_of(slot);
      receive(packet_in(pool.slot(slot)));
      pool.give(slot);
      slot = next;
    }
    return count;
  }

  /// Calls accept(packet) for each, oldest first, until it returns false: that packet and the following ones are offered again by
  /// the next call. Returns whether there is none left. A receiver that calls it does not call drain().
  template <class Accept>
  bool drain_while(Accept&& accept) {
    if (offered_ == empty && !is_empty()) {
      offered_ = turned_round(inbox_->exchange(empty, std::memory_order_acquire));  // partner: as in drain()
    }
    while (offered_ != empty) {
      const SlotIndex slot = offered_;
      Pool& pool = pool_of(slot);
      if (!accept(packet_in(pool.slot(slot)))) {
        return false;
      }
      offered_ = links_[slot].load(std::memory_order_relaxed);
      pool.give(slot);
    }
    return true;
  }

  /// Tests without taking anything, for a receiver that is awake: may miss a packet that is just arriving.
  bool is_empty() const { return inbox_->load(std::memory_order_relaxed) == empty; }

  /// As is_empty(), for a caller of drain_while(): nothing waits to be offered again, either.
  bool is_drained() const { return offered_ == empty && is_empty(); }

  /// Whether there is a packet; after a run, when nobody sends.
  bool has_packets() const {
    const SlotIndex head = inbox_->load(std::memory_order_relaxed);
    return head != empty && head != asleep;
  }

  /// Announces sleep, unless a packet has arrived: then false, and drain() finds it. After true call wait(), or end for good.
  /// Acquire: after true the caller sees what any thread wrote before a rouse() that came too early to find it asleep.
  [[nodiscard]] bool fall_asleep() {
    SlotIndex expected = empty;
    return inbox_->compare_exchange_strong(expected, asleep, std::memory_order_acquire, std::memory_order_relaxed);
  }

  /// After fall_asleep() returned true: blocks until a push() or a rouse() has replaced ASLEEP, and little longer if that thread
  /// then stops before it wakes this one. Orders nothing: drain() and fall_asleep() do.
  void wait() const {
    for (auto most = look_first; inbox_->load(std::memory_order_relaxed) == asleep; most = std::min(2 * most, look_last)) {
      Atomics::sleep(*inbox_, asleep, most);
    }
  }

  /// Waits for `most` at most; the receiver is awake afterwards. For a receiver that `awake` does not count.
  void wait(std::chrono::nanoseconds most) {
    Atomics::sleep(*inbox_, asleep, most);
    SlotIndex expected = asleep;
    inbox_->compare_exchange_strong(expected, empty, std::memory_order_relaxed, std::memory_order_relaxed);
  }

  /// Wakes the receiver without a packet, or makes its next fall_asleep() see what the caller wrote before. For the end of a run:
  /// it does not touch the count of awake nodes.
  void rouse() {
    SlotIndex head = inbox_->load(std::memory_order_relaxed);
    // Release, also where the word stays the same: partner of the acquire in fall_asleep() and drain().
    while (!inbox_->compare_exchange_weak(head, head == asleep ? empty : head, std::memory_order_release,
                                          std::memory_order_relaxed)) {
    }
    if (head == asleep) {
      wake_receiver();
    }
  }

  /// What a mailbox of this capacity takes of the local memory, in bytes.
  static std::size_t bytes(const MailboxCapacity& capacity) {
    return LocalMemory::bytes_for<Inbox>(1) + LocalMemory::bytes_for<Atomic<SlotIndex>>(link_count(capacity)) +
           2 * LocalMemory::bytes_for<Head>(1) + slot_count(capacity.small_slots) * small_stride_bytes(capacity) +
           slot_count(capacity.bulk_slots) * bulk_slot_bytes(capacity);
  }

 private:
  template <class T>
  using Atomic = typename Atomics::template Atomic<T>;
  using Pool = BasicSlotPool<Atomics>;
  using Head = typename Pool::Head;

  static constexpr SlotIndex empty = no_slot;
  static constexpr SlotIndex asleep = 0xFFFFFFFE;

  struct alignas(cache_line_bytes) Inbox {
    Atomic<SlotIndex> word{empty};
  };
  /// The maximum number of links on a cache line.
  static constexpr SlotIndex links_a_line = cache_line_bytes / sizeof(SlotIndex);
  static_assert(small_slot_bytes % cache_line_bytes == 0, "two packets never share a cache line");
  static_assert(LocalMemory::alignment % cache_line_bytes == 0, "local memory hands out whole cache lines");
  static_assert(sizeof(Inbox) % cache_line_bytes == 0 && sizeof(Head) % cache_line_bytes == 0 &&
                    links_a_line * sizeof(Atomic<SlotIndex>) % cache_line_bytes == 0,
                "invariant (4)");

  /// Interval of a sleeper's first poll, and the longest: few nodes sleep so long that it costs them anything, and 4096 that
  /// sleep for good take some hundredths of a core.
  static constexpr std::chrono::milliseconds look_first{16}, look_last{1000};

  static SlotIndex slot_count(std::uint32_t capacity) { return capacity == 0 ? 0 : capacity + 1; }
  /// The first bulk slot's number, and index among the links: after the small ones', on a line of its own.
  static SlotIndex first_bulk(const MailboxCapacity& capacity) {
    return core::round_up(slot_count(capacity.small_slots), links_a_line);
  }
  static std::size_t link_count(const MailboxCapacity& capacity) {
    return std::size_t{first_bulk(capacity)} + slot_count(capacity.bulk_slots);
  }
  static std::size_t small_stride_bytes(const MailboxCapacity& capacity) {
    return core::round_up(small_slot_bytes + capacity.small_front_bytes, cache_line_bytes);
  }
  static std::size_t bulk_slot_bytes(const MailboxCapacity& capacity) {
    return core::round_up(sizeof(PacketHeader) + capacity.bulk_payload_bytes, cache_line_bytes);
  }

  Pool make_pool(LocalMemory& memory, SlotIndex first, std::uint32_t capacity, std::size_t stride_bytes) {
    core::expect(link_count_limit > links_.size(), "slots are numbered below EMPTY and ASLEEP");
    Head& head = memory.allocate<Head>(Category::mailbox, 1).front();
    const auto slots = memory.allocate<std::byte>(Category::mailbox, slot_count(capacity) * stride_bytes);
    return Pool(head, links_, first, slots, stride_bytes);
  }

  Pool& pool_of(SlotIndex slot) { return slot < small_slots_ ? small_ : bulk_; }

  [[nodiscard]] bool put(Batch& batch, const PacketHeader& header, std::span<const std::byte> front,
                         std::span<const std::byte> payload) {
    const bool is_small = header.bytes <= small_payload_bytes_;
    core::expect(is_small || header.bytes <= bulk_payload_bytes_, "a payload fits the slots of its class");
    Pool& pool = is_small ? small_ : bulk_;
    const SlotIndex slot = pool.take();
    if (slot == no_slot) {
      return false;
    }
    fill(pool.slot(slot), header, front, payload);
    links_[slot].store(batch.newest_, std::memory_order_relaxed);
    batch.oldest_ = batch.is_empty() ? slot : batch.oldest_;
    batch.newest_ = slot;
    return true;
  }

  static void fill(std::span<std::byte> slot, const PacketHeader& header, std::span<const std::byte> front,
                   std::span<const std::byte> payload) {
    Atomics::writes(slot.data());
    std::memcpy(slot.data(), &header, sizeof(header));
    if (!front.empty()) {
      std::memcpy(slot.data() + sizeof(header), front.data(), front.size());
    }
    if (!payload.empty()) {
      std::memcpy(slot.data() + sizeof(header) + front.size(), payload.data(), payload.size());
    }
  }

  static Packet packet_in(std::span<const std::byte> slot) {
    Atomics::reads(slot.data());
    PacketHeader header;
    std::memcpy(&header, slot.data(), sizeof(header));
    const std::span<const std::byte> payload = slot.subspan(sizeof(header));
    if (header.end_in_place == 0) {
      return {NodeId{header.source}, header.kind, payload.first(header.bytes)};
    }
    std::span<const std::byte> immutable;
    std::memcpy(&immutable, payload.data(), sizeof(immutable));
    const std::size_t front_bytes = header.bytes - immutable.size();
    return {NodeId{header.source}, header.kind, payload.subspan(sizeof(immutable), front_bytes), immutable};
  }

  /// One attempt to put `batch` on the inbox whose word was `head`; updates `head` if that failed.
  bool try_publish(const Batch& batch, SlotIndex& head, BasicAwakeCount<Atomics>& awake) {
    const bool wakes = head == asleep, counts = wakes && wake_up_ == nullptr;
    links_[batch.oldest_].store(wakes ? empty : head, std::memory_order_relaxed);
    if (counts) {
      awake.raise();
    }
    // Release: partner of the acquire in drain(), for the slots' bytes and their links.
    const bool published =
        inbox_->compare_exchange_weak(head, batch.newest_, std::memory_order_release, std::memory_order_relaxed);
    if (wakes && published) {
      wake_receiver();
    } else if (counts) {
      awake.withdraw();
    }
    return published;
  }

  void wake_receiver() { wake_up_ == nullptr ? Atomics::wake(*inbox_) : wake_up_->ring(); }

  /// Reverses a stack taken from the inbox; returns its oldest slot.
  SlotIndex turned_round(SlotIndex newest) {
    SlotIndex done = empty;
    while (newest != empty) {
      const SlotIndex older = links_[newest].load(std::memory_order_relaxed);
      links_[newest].store(done, std::memory_order_relaxed);
      done = newest;
      newest = older;
    }
    return done;
  }

  static constexpr std::size_t link_count_limit = asleep;

  SlotIndex small_slots_;
  SlotIndex offered_ = empty;  ///< the oldest packet that drain_while() has taken and not passed on
  std::size_t small_payload_bytes_, bulk_payload_bytes_;
  Atomic<SlotIndex>* inbox_;
  std::span<Atomic<SlotIndex>> links_;
  Pool small_;
  Pool bulk_;
  WakeUp* wake_up_ = nullptr;
};

using Mailbox = BasicMailbox<SystemAtomics>;

inline std::size_t MailboxCapacity::bytes() const { return Mailbox::bytes(*this); }

}  // namespace dmpc::nodes
