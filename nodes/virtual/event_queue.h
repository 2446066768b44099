// What is going to happen, in the one order that virtual time allows.
#pragma once

#include <cstdint>
#include <queue>
#include <tuple>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::nodes {

/// Something that happens at a time. Ordered by (time, source, sequence): the node whose action made the event, and that node's
/// own count of its events, so that the order does not depend on how the host came to make them.
struct Event {
  enum class Kind : std::uint8_t {
    enters,   ///< a message enters the network
    arrives,  ///< a message is at its target
    is_free   ///< a node's processor has done what it was doing
  };
  std::uint64_t time_ns = 0;
  std::uint64_t sequence = 0;
  std::uint32_t source = 0;
  Kind kind = Kind::is_free;
  std::uint32_t packet = 0;  ///< of a message: its number in the runner's store

  std::tuple<std::uint64_t, std::uint32_t, std::uint64_t> key() const { return {time_ns, source, sequence}; }
};

/// Not thread-safe.
class EventQueue {
 public:
  /// Requires a time that is not before that of the last event popped.
  void push(const Event& event) {
    core::expect(event.time_ns >= now_ns_, "nothing happens before now");
    events_.push(event);
  }
  bool empty() const { return events_.empty(); }
  /// The least event, which is now.
  Event pop() {
    core::expect(!events_.empty(), "an event is popped that is there");
    const Event event = events_.top();
    events_.pop();
    now_ns_ = event.time_ns;
    return event;
  }
  std::uint64_t now_ns() const { return now_ns_; }

 private:
  struct Later {
    bool operator()(const Event& a, const Event& b) const { return a.key() > b.key(); }
  };
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  std::uint64_t now_ns_ = 0;
};

}  // namespace dmpc::nodes
