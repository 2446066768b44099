// Backpressure when rays pile up: a node whose queue grows long asks all others to start no primary rays until it is short again.
//
// Credits bound what lies between two nodes, but not what passes through one on its way to a slow third one: there rays pile up
// until they overflow, while others go on starting new ones. So the node where they do announces it. Nothing else waits for this:
// rays in flight go on, so every queue gets short again and every announcement is revoked.
//
// Recipients: a node announces to all others. Where nodes are so many that owners' slots are shared, it announces to the host
// alone, which informs all nodes when the first node asks and when the last has revoked, along the tree of termination.h: a
// member informs those below, and acknowledges when they have. So a node's mailbox has slots for one announcement and a few
// acknowledgements, instead of one of each for each other node.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/base/expect.h"

namespace dmpc::dataflow {

/// A node announces that its queue is long from this number of packets on.
constexpr std::uint32_t long_queue(std::uint32_t capacity_packets) { return std::max(1U, capacity_packets / 4); }
/// A node revokes it at this number: neither at once, or announcements would never end, nor too late, or nodes would idle. At or
/// below it a node starts primary rays: packets that wait for others' credits need not keep it idle.
constexpr std::uint32_t short_queue(std::uint32_t capacity_packets) { return capacity_packets / 8; }

/// One node's part. It sends no packets: it gets the length of the queue, announcements and acknowledgements. A node announces
/// again only when all recipients have acknowledged its last announcement, so one slot for each in every mailbox is enough.
/// Belongs to one program.
class Backpressure {
 public:
  /// `reported`: the number of recipients. If `is_wanted` is false the node announces nothing and always starts primary rays, as
  /// in the article.
  Backpressure(std::uint32_t reported, std::uint32_t queue_capacity_packets, bool is_wanted = true)
      : reported_(reported), capacity_(queue_capacity_packets), is_wanted_(is_wanted) {}
  /// The host's capacity as a relay: instead of packets its queue holds holders(), of which one is many.
  static constexpr std::uint32_t relay_capacity = 1;

  /// Whether an announcement is due with `queued` packets in the queue.
  bool is_due(std::uint32_t queued) const { return missing_ == 0 && wants(queued) != is_announced_; }
  /// Requires is_due(queued). Returns the announcement for all recipients: true if they shall throttle primary rays.
  bool announce(std::uint32_t queued) {
    core::expect(is_due(queued), "a node announces what is new, when the last announcement is acknowledged");
    is_announced_ = !is_announced_;
    missing_ = reported_;
    count_ += is_announced_ ? 1 : 0;
    return is_announced_;
  }
  /// To be called when a recipient has acknowledged.
  void acknowledged() {
    core::expect(missing_ > 0, "an acknowledgement answers an announcement");
    --missing_;
  }

  /// To be called when another's announcement has arrived, which is then acknowledged.
  void take(bool holds) {
    core::expect(holds || holders_ > 0, "only what was announced is taken back");
    holders_ += holds ? 1 : -1U;
  }
  /// Whether primary rays may start with `queued` packets in the queue: if these are few and no other node asks to throttle.
  bool admits_primaries(std::uint32_t queued) const { return !is_wanted_ || (queued <= short_queue(capacity_) && holders_ == 0); }

  /// Whether every announcement is revoked and acknowledged.
  bool is_settled() const { return !is_announced_ && missing_ == 0; }
  /// How often this node asked the others to throttle.
  std::uint64_t count() const { return count_; }
  /// For the key of a model's state.
  std::uint32_t missing() const { return missing_; }
  /// The number of nodes that ask this one to throttle.
  std::uint32_t holders() const { return holders_; }
  bool is_announced() const { return is_announced_; }

 private:
  bool wants(std::uint32_t queued) const {
    return is_wanted_ && (queued >= long_queue(capacity_) || (is_announced_ && queued > short_queue(capacity_)));
  }

  std::uint32_t reported_;
  std::uint32_t capacity_;
  bool is_wanted_;
  std::uint32_t missing_ = 0;  ///< acknowledgements
  std::uint32_t holders_ = 0;  ///< others that ask this one to throttle
  std::uint64_t count_ = 0;
  bool is_announced_ = false;
};

}  // namespace dmpc::dataflow
