// The pending events, in order of virtual time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// An event at a time. Ordered by (time, source, sequence): the node whose action made the event, and that node's own count of
/// its events, so that the order does not depend on how the real computer made them.
struct Event {
  enum class Kind : std::uint8_t {
    enters,   ///< a message enters the network
    arrives,  ///< a message is at its target
    is_free   ///< a node's processor has finished its activity
  };
  __extension__ using Order = unsigned __int128;
  /// As one number; sequences are below 2^48.
  static constexpr Order order_of(std::uint64_t time_ns, NodeId source, std::uint64_t sequence) {
    return Order{time_ns} << 64U | (std::uint64_t{index_of(source)} << 48U | sequence);
  }

  Order order = 0;
  Kind kind = Kind::is_free;
  std::uint32_t packet = 0;  ///< for a message: its number in the runner's store

  std::uint64_t time_ns() const { return static_cast<std::uint64_t>(order >> 64U); }
  std::uint32_t source() const { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(order) >> 48U); }
};

/// Most events are near, and lie by their time in a ring of slots, each a short sorted list (R. Brown, "Calendar Queues", 1988);
/// events that are far, or would make a list long, are in a binary heap. The least of both is next, so the place of an event does
/// not affect the order. Not thread-safe.
class EventQueue {
 public:
  /// `slot_ns`, at least 1, is about the time from one event to the next.
  explicit EventQueue(std::uint64_t slot_ns = 1) : slot_shift_(static_cast<unsigned>(std::bit_width(slot_ns) - 1)) {
    core::expect(slot_ns > 0, "a slot has a time");
    slots_.fill(none);
  }

  /// Requires a time that is not before that of the last event popped.
  void push(const Event& event) {
    core::expect(event.time_ns() >= now_ns_, "nothing happens before now");
    ++count_;
    const std::uint64_t slot = event.time_ns() >> slot_shift_;
    if (slot - (now_ns_ >> slot_shift_) >= slot_count || !put(event, slot % slot_count)) {
      far_.push_back(event);
      std::push_heap(far_.begin(), far_.end(), is_later);
    }
  }
  bool empty() const { return count_ == 0; }
  /// Removes the least event, whose time is now.
  Event pop() {
    core::expect(!empty(), "an event is popped that is there");
    const bool is_near = count_ > far_.size();
    const std::size_t slot = is_near ? first_slot() : 0;
    const bool is_in_slot = is_near && (far_.empty() || is_later(far_.front(), places_[slots_[slot]].event));
    --count_;
    const Event event = is_in_slot ? take(slot) : take_far();
    now_ns_ = event.time_ns();
    return event;
  }
  std::uint64_t now_ns() const { return now_ns_; }

 private:
  struct Place {
    Event event;
    std::uint32_t next = 0;  ///< in the list of a slot, or in the free list
  };
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::size_t slot_count = 512, word_bits = 64, word_count = slot_count / word_bits;
  static constexpr int steps_max = 8;  ///< maximum in a list, to the place of an event

  static bool is_later(const Event& a, const Event& b) { return b.order < a.order; }

  /// Returns false if the slot's list is too long.
  bool put(const Event& event, std::size_t slot) {
    std::uint32_t before = none, at = slots_[slot];
    for (int steps = 0; at != none && places_[at].event.order < event.order; ++steps) {
      if (steps == steps_max) {
        return false;
      }
      before = at;
      at = places_[at].next;
    }
    const std::uint32_t place = free_place();
    places_[place] = {event, at};
    (before == none ? slots_[slot] : places_[before].next) = place;
    filled_[slot / word_bits] |= std::uint64_t{1} << slot % word_bits;
    return true;
  }

  std::uint32_t free_place() {
    if (free_ == none) {
      places_.push_back({.next = none});
      return static_cast<std::uint32_t>(places_.size() - 1);
    }
    return std::exchange(free_, places_[free_].next);
  }

  /// The first slot with an event from now on, round the ring. Requires an event in some slot.
  std::size_t first_slot() const {
    const std::size_t now = (now_ns_ >> slot_shift_) % slot_count;
    std::size_t word = now / word_bits;
    std::uint64_t filled = filled_[word] & ~std::uint64_t{0} << now % word_bits;
    while (filled == 0) {
      word = (word + 1) % word_count;
      filled = filled_[word];
    }
    return word * word_bits + static_cast<std::size_t>(std::countr_zero(filled));
  }

  Event take(std::size_t slot) {
    const std::uint32_t place = slots_[slot];
    slots_[slot] = std::exchange(places_[place].next, free_);
    free_ = place;
    if (slots_[slot] == none) {
      filled_[slot / word_bits] &= ~(std::uint64_t{1} << slot % word_bits);
    }
    return places_[place].event;
  }

  Event take_far() {
    std::pop_heap(far_.begin(), far_.end(), is_later);
    const Event event = far_.back();
    far_.pop_back();
    return event;
  }

  unsigned slot_shift_;
  std::array<std::uint32_t, slot_count> slots_{};   ///< by time: the first place of the list, or none
  std::array<std::uint64_t, word_count> filled_{};  ///< a bit for each slot that has a list
  std::vector<Place> places_;
  std::uint32_t free_ = none;
  std::vector<Event> far_;
  std::size_t count_ = 0;
  std::uint64_t now_ns_ = 0;
};

}  // namespace dmpc::nodes
