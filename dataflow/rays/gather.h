// Outgoing rays: gathered by owner, in packets that are sent when they are full or when the node has no other work.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "dataflow/flow_control.h"
#include "dataflow/packets.h"
#include "nodes/layout.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Counters of what one node has sent another, by either way.
struct PairCounters {
  std::array<std::uint64_t, core::ray_kind_count> rays{};  ///< by kind; confirmed hits included
  std::uint64_t packets = 0;                               ///< with rays; their bytes follow from both
  std::uint64_t rays_overflowed = 0;                       ///< with rays; their bytes follow from both

  std::uint64_t rays_total() const { return std::accumulate(rays.begin(), rays.end(), std::uint64_t{0}); }
};

/// Counters of what a node has sent one owner, if there is anything.
struct SentToOwner : PairCounters {
  std::uint32_t owner = 0;  ///< its index
};

/// Open packets for a limited number of owners, and a queue of closed ones that found no credit, with shared slots for all
/// owners. At most one closed packet finds no slot there either, and while it waits nothing may be added. Keeps account of the
/// node's credits for rays, and asks for them where owners share their slots. Thread safety: belongs to one node.
class Gather {
  struct Slot;
  struct Owner;

 public:
  struct Capacity {
    std::uint32_t node_count = 1;
    std::uint32_t ray_batch = 1;       ///< rays in a full packet
    std::uint32_t ray_credits = 1;     ///< for each other node
    bool shares_slots = false;         ///< owners are asked for credits; if not, and without credits, all go through the host
    std::uint32_t open_packets = 0;    ///< maximum number that is filled at a time; 0: one for each node
    std::uint32_t host_credits = 1;    ///< for the host, node `node_count`; at least 1
    std::uint32_t queue_packets = 0;   ///< full packets that may wait for their owners' credits
    std::uint32_t tested_objects = 0;  ///< names per ray

    /// Number of open and queued packets.
    std::uint32_t packets() const { return open_packets_max() + queue_packets; }
    std::uint32_t open_packets_max() const { return open_packets == 0 ? node_count : open_packets; }
    /// With shared slots: the maximum number of unanswered requests to owners. More owners than packets could only be those whose
    /// rays have gone through the host.
    std::uint32_t asks_max() const { return std::min(node_count - 1, packets()); }
  };

  /// What the gather has sent.
  struct Counters {
    std::uint64_t packets = 0;             ///< by either way
    std::uint64_t rays = 0;                ///< in them
    std::uint64_t packets_overflowed = 0;  ///< packets sent through the host
    std::uint64_t rays_overflowed = 0;
    std::uint64_t packets_flushed = 0;   ///< packets closed before they were full
    std::uint64_t packets_queued = 0;    ///< packets sent after a time in the queue
    std::uint64_t queue_high_water = 0;  ///< the most packets in the queue at once

    /// Sums; the maximum for the high water.
    Counters& operator+=(const Counters& more);
    /// Mean rays in a packet over `ray_batch`, those in a full one, in (0, 1]; 1 without packets.
    double mean_fill(std::uint32_t ray_batch) const {
      return packets == 0 ? 1.0 : static_cast<double>(rays) / static_cast<double>(packets) / ray_batch;
    }
  };

  /// Takes the credits.
  Gather(nodes::Node& node, const Capacity& capacity);
  /// The memory that the constructor takes.
  static nodes::Layout<std::byte, Slot, Owner> layout(const Capacity& capacity);

  /// To be called when the receiver has taken `count` packets, or grants a slot. Sends it the queued ones that these credits
  /// allow, or returns a granted one, and returns the number of packets sent on the channel of rays.
  std::uint32_t credits_returned(nodes::NodeId receiver, std::uint32_t count);

  /// Requires that no packet waits. If the packet for `owner` is full now, it is closed; or, if as many are open as there are
  /// slots, the fullest, preferably one that may be sent.
  void add(nodes::NodeId owner, const RayMessage& message) {
    add(owner, message.ray.kind, [&message](std::span<std::byte> place) { copy_message(place.data(), &message, place.size()); });
  }
  /// add() for a ray of a kind that put(place) writes into the bytes of its message in the packet.
  template <class Put>
  void add(nodes::NodeId owner, core::RayKind kind, const Put& put) {
    put(place_for(owner));
    added(owner, kind);
  }
  /// Closes the fullest packet that can be sent. Requires can_flush().
  void flush();
  /// Sends the closed packet to its owner, to the queue or to the host, by the rules of flow_control.h; returns which.
  Way send();

  /// Whether a packet is closed and not sent: call send().
  bool waits() const { return closed_.has_value(); }
  /// Whether some open packet has rays and its owner's credit.
  bool can_flush() const;
  /// Packets in the queue.
  std::uint32_t queued() const { return queued_; }
  /// Whether no ray is here.
  bool empty() const { return size_ == 0; }
  /// Whether some owner has been asked for a slot and has not granted it.
  bool is_unanswered() const { return asked_ > 0; }
  /// Number of rays here, including queued ones.
  std::uint32_t size() const { return size_; }
  const Counters& counters() const { return counters_; }
  /// Packets report from now on that this number of rays is left.
  void report(std::uint32_t rays_left) { rays_left_ = rays_left; }
  /// By owner, of those for which there has been a ray here; counts rays gathered, and packets sent.
  std::vector<SentToOwner> pairs() const;

 private:
  /// Slots are numbered from 1 on.
  static constexpr std::uint16_t none = 0;

  /// A packet's slot.
  struct Slot {
    std::uint16_t next = none;  ///< next slot of the same owner's queue, or of the free list
    std::uint16_t count = 0;    ///< rays
  };
  /// Begins as zeros, so that no memory is committed for owners to which no ray of this node goes: most of them, if there are
  /// many.
  struct Owner {
    std::uint16_t open = none;                ///< the slot that is being filled
    std::uint16_t first = none, last = none;  ///< queued, in the order of closing
    std::uint16_t has_asked = 0;              ///< 1: for a slot that is not granted yet
    PairCounters pair;
  };
  static std::size_t stride_bytes(std::size_t bytes);

  std::span<std::byte> place_for(nodes::NodeId owner);
  void added(nodes::NodeId owner, core::RayKind kind);

  std::span<std::byte> packet_in(std::uint16_t slot) const;
  bool has_credit(nodes::NodeId owner) const { return node_->credits(owner, ray_channel) > 0; }
  Owner& owner_at(nodes::NodeId owner) const { return owners_[nodes::index_of(owner)]; }
  Slot& slot_at(std::uint16_t slot) const { return slots_[slot - 1]; }
  bool may_leave(nodes::NodeId owner) const;
  bool has_rays_for(const Owner& owner) const { return owner.open != none || owner.first != none; }
  bool wants_to_ask(nodes::NodeId owner) const;
  void ask(nodes::NodeId owner);
  void ask_others(nodes::NodeId answering);
  bool ask_or_decline(nodes::NodeId owner);
  template <class May>
  std::optional<nodes::NodeId> fullest(const May& may) const;
  void close_one();
  template <class Visit>
  void for_each_open(const Visit& visit) const;
  void set_open(nodes::NodeId owner, std::uint16_t slot);
  void enqueue(nodes::NodeId owner);
  void dequeue(nodes::NodeId owner);
  void transmit(nodes::NodeId owner, std::uint16_t slot, bool overflows);
  void release(std::uint16_t slot);

  nodes::Node* node_;
  nodes::NodeId host_;
  std::uint32_t ray_batch_;
  std::uint32_t queue_capacity_;
  std::uint32_t tested_objects_;
  std::uint32_t open_packets_max_;
  std::uint32_t asks_max_;
  bool shares_slots_;
  bool are_nodes_joined_;  ///< there are credits between nodes
  std::span<std::byte> room_;
  std::span<Slot> slots_;
  std::span<Owner> owners_;
  std::array<std::uint64_t, region_count_max / 64> open_{};  ///< a bit for each owner whose packet is being filled
  std::uint16_t free_ = none;
  std::uint32_t size_ = 0;
  std::uint32_t queued_ = 0;
  std::uint32_t open_count_ = 0;
  std::uint32_t asked_ = 0;              ///< owners
  bool has_put_off_asking_ = false;      ///< some owner was not asked, since the maximum number was
  std::optional<nodes::NodeId> closed_;  ///< owner whose open packet is closed
  Counters counters_;
  std::uint32_t rays_left_ = 0;  ///< to be reported
};

}  // namespace dmpc::dataflow
