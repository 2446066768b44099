// What is going to happen, in the one order that virtual time allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/expect.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// Something that happens at a time. Ordered by (time, source, sequence): the node whose action made the event, and that node's
/// own count of its events, so that the order does not depend on how the host came to make them.
struct Event {
  enum class Kind : std::uint8_t {
    enters,   ///< a message enters the network
    arrives,  ///< a message is at its target
    is_free   ///< a node's processor has done what it was doing
  };
  __extension__ using Order = unsigned __int128;
  /// As one number; sequences are below 2^48.
  static constexpr Order order_of(std::uint64_t time_ns, NodeId source, std::uint64_t sequence) {
    return Order{time_ns} << 64U | (std::uint64_t{index_of(source)} << 48U | sequence);
  }

  Order order = 0;
  Kind kind = Kind::is_free;
  std::uint32_t packet = 0;  ///< of a message: its number in the runner's store

  std::uint64_t time_ns() const { return static_cast<std::uint64_t>(order >> 64U); }
  std::uint32_t source() const { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(order) >> 48U); }
};

/// A binary heap. What happens to a node or a message mostly makes its next event, so the place of an event that has been popped
/// waits for one that is pushed, which saves half of the steps. Not thread-safe.
class EventQueue {
 public:
  /// Requires a time that is not before that of the last event popped.
  void push(const Event& event) {
    core::expect(event.time_ns() >= now_ns_, "nothing happens before now");
    if (is_top_gone_) {
      is_top_gone_ = false;
      sink(event);
    } else {
      rise(event);
    }
  }
  bool empty() const { return events_.size() == (is_top_gone_ ? 1 : 0); }
  /// The least event, which is now.
  Event pop() {
    core::expect(!empty(), "an event is popped that is there");
    if (is_top_gone_) {
      const Event last = events_.back();
      events_.pop_back();
      sink(last);
    }
    is_top_gone_ = true;
    now_ns_ = events_.front().time_ns();
    return events_.front();
  }
  std::uint64_t now_ns() const { return now_ns_; }

 private:
  /// Puts `event` where the top is gone.
  void sink(const Event& event) {
    Event* const events = events_.data();
    const std::size_t count = events_.size();
    std::size_t place = 0;
    for (std::size_t below = 1; below < count; below = 2 * place + 1) {
      if (below + 1 < count) {
        below += events[below + 1].order < events[below].order ? 1U : 0U;
      }
      if (event.order < events[below].order) {
        break;
      }
      events[place] = events[below];
      place = below;
    }
    events[place] = event;
  }

  void rise(const Event& event) {
    events_.push_back(event);
    Event* const events = events_.data();
    std::size_t place = events_.size() - 1;
    for (; place > 0 && event.order < events[(place - 1) / 2].order; place = (place - 1) / 2) {
      events[place] = events[(place - 1) / 2];
    }
    events[place] = event;
  }

  std::vector<Event> events_;
  bool is_top_gone_ = false;  ///< the event that stands there has been popped
  std::uint64_t now_ns_ = 0;
};

}  // namespace dmpc::nodes
