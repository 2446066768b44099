// The word that goes round when rays pile up: a node whose queue grows long asks all others to start no primary rays until it is
// short again.
//
// Credits bound what lies between two nodes, not what passes through one on its way to a third that is slow: there rays pile up
// until they overflow, while others go on starting new ones. So the node where they do says so. Nothing else waits for this: rays
// on their way go on, so every queue gets short again and every announcement is taken back.
//
// Who tells whom: a node tells all others. Where nodes are so many that owners' places are shared, too, it tells the host alone,
// which tells all nodes when the first of them asks and when the last has taken it back, along the tree of termination.h: who is
// told tells those below, and acknowledges when they have. So a node's mailbox has room for one announcement and a few
// acknowledgements, in place of one of each from each other node.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/base/expect.h"

namespace dmpc::dataflow {

/// From how many queued packets a node announces that its queue is long.
constexpr std::uint32_t long_queue(std::uint32_t capacity_packets) { return std::max(1U, capacity_packets / 4); }
/// Down to how many it takes that back: neither at once, or announcements would never end, nor too late, or nodes would idle.
/// With no more of its own a node starts primary rays: what waits for others' credits need not keep it idle.
constexpr std::uint32_t short_queue(std::uint32_t capacity_packets) { return capacity_packets / 8; }

/// One node's part. It decides nothing about packets: it is told the length of the queue, of announcements and of
/// acknowledgements. A node announces again only when all whom it tells have acknowledged its last announcement, so one place for
/// each in every mailbox is enough. Belongs to one program.
class Backpressure {
 public:
  /// `told`: to how many it announces. With `is_wanted` false the node announces nothing and starts primary rays whatever waits,
  /// as the article's did.
  Backpressure(std::uint32_t reported, std::uint32_t queue_capacity_packets, bool is_wanted = true)
      : reported_(reported), capacity_(queue_capacity_packets), is_wanted_(is_wanted) {}
  /// The host's capacity, where nodes tell it alone: in place of packets it has holders() in its queue, of whom one is many.
  static constexpr std::uint32_t relay_capacity = 1;

  /// Whether something is to be announced with `queued` packets in the queue.
  bool is_due(std::uint32_t queued) const { return missing_ == 0 && wants(queued) != is_announced_; }
  /// Requires is_due(queued). The announcement, for all whom it tells: true if they shall hold primary rays back.
  bool announce(std::uint32_t queued) {
    core::expect(is_due(queued), "a node announces what is new, when the last announcement is acknowledged");
    is_announced_ = !is_announced_;
    missing_ = reported_;
    count_ += is_announced_ ? 1 : 0;
    return is_announced_;
  }
  /// One of those whom it tells has taken notice.
  void acknowledged() {
    core::expect(missing_ > 0, "an acknowledgement answers an announcement");
    --missing_;
  }

  /// Another's announcement has come: acknowledge it.
  void take(bool holds) {
    core::expect(holds || holders_ > 0, "only what was announced is taken back");
    holders_ += holds ? 1 : -1U;
  }
  /// Primary rays may start with `queued` packets in the queue: with few, unless another node asks to hold them back.
  bool admits_primaries(std::uint32_t queued) const { return !is_wanted_ || (queued <= short_queue(capacity_) && holders_ == 0); }

  /// Nothing is announced that has not been taken back, and every announcement is acknowledged.
  bool is_settled() const { return !is_announced_ && missing_ == 0; }
  /// How often this node asked the others to throttle.
  std::uint64_t count() const { return count_; }
  /// For the key of a model's state.
  std::uint32_t missing() const { return missing_; }
  /// Who asks this one to throttle; at the host, how many nodes do.
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
