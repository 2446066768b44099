// Rays on their way out: gathered by owner until a packet is full or the node has no other work.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>

#include "core/expect.h"
#include "core/units.h"
#include "dataflow/flow_control.h"
#include "dataflow/packets.h"
#include "nodes/node.h"

namespace dmpc::dataflow {

/// Packets that may be under way to each owner, one travelling and one being worked off, when a primary ray is started; fewer if
/// there are no more credits.
inline constexpr std::uint32_t primary_window = 2;

/// One open packet an owner; at most one of them waits for a credit, and meanwhile nothing may be added. Keeps account of the
/// node's credits for rays. Thread safety: belongs to one node.
class Gather {
 public:
  struct Capacity {
    std::uint32_t node_count = 1;
    std::uint32_t ray_batch = 1;     ///< rays in a full packet
    std::uint32_t ray_credits = 1;   ///< for each other node; 0: all rays go by way of the host
    std::uint32_t host_credits = 1;  ///< for the host, node `node_count`; at least 1
  };

  /// What the gather has sent.
  struct Counters {
    std::uint64_t packets = 0;             ///< by either way
    std::uint64_t rays = 0;                ///< in them
    std::uint64_t packets_overflowed = 0;  ///< of them, by way of the host
    std::uint64_t rays_overflowed = 0;
    std::uint64_t packets_flushed = 0;  ///< of them, sent before they were full

    Counters& operator+=(const Counters& more) {
      packets += more.packets;
      rays += more.rays;
      packets_overflowed += more.packets_overflowed;
      rays_overflowed += more.rays_overflowed;
      packets_flushed += more.packets_flushed;
      return *this;
    }
  };

  /// Takes the credits.
  Gather(nodes::Node& node, const Capacity& capacity)
      : node_(&node),
        host_(nodes::NodeId{capacity.node_count}),
        ray_batch_(capacity.ray_batch),
        credits_kept_(capacity.ray_credits - std::min(primary_window, std::max(capacity.ray_credits, 1U) - 1)),
        room_(node.memory().allocate<std::byte>(nodes::Category::queues, room_bytes(capacity))),
        counts_(node.memory().allocate<std::uint16_t>(nodes::Category::queues, capacity.node_count)) {
    for (std::uint32_t i = 0; i < capacity.node_count; ++i) {
      node.grant(nodes::NodeId{i}, ray_channel, nodes::NodeId{i} == node.id() ? 0 : capacity.ray_credits);
    }
    node.grant(host_, ray_channel, capacity.host_credits);
  }
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, const Capacity& capacity) {
    using nodes::LocalMemory;
    plan[nodes::Category::queues] +=
        LocalMemory::bytes_for<std::byte>(room_bytes(capacity)) + LocalMemory::bytes_for<std::uint16_t>(capacity.node_count);
  }

  /// The receiver has taken up `count` packets.
  void credits_returned(nodes::NodeId receiver, std::uint32_t count) {
    const bool was_behind = is_behind(receiver);
    node_->grant(receiver, ray_channel, count);
    behind_ -= was_behind && !is_behind(receiver) ? 1 : 0;
  }
  /// No owner is behind with more than primary_window packets of this node's: the other credits are for rays that cannot wait.
  bool admits_primaries() const { return behind_ == 0; }

  /// Requires that no packet waits. If the packet for `owner` is full now, it waits.
  void add(nodes::NodeId owner, const RayMessage& message) {
    core::expect(!waits(), "no ray is gathered while a packet waits");
    core::expect(owner != node_->id() && owner != host_, "a ray leaves for another node");
    std::uint16_t& count = counts_[nodes::index_of(owner)];
    std::memcpy(packet_of(owner).data() + ray_packet_bytes(count), &message, sizeof(message));
    ++size_;
    if (++count == ray_batch_) {
      waiting_ = owner;
    }
  }

  /// Closes the fullest packet: it waits to be sent. Requires rays, and that no packet waits.
  void close_fullest() {
    core::expect(size_ > 0 && !waits(), "only an open packet is closed");
    std::uint32_t fullest = 0;
    for (std::uint32_t owner = 1; owner < counts_.size(); ++owner) {
      fullest = counts_[owner] > counts_[fullest] ? owner : fullest;
    }
    waiting_ = nodes::NodeId{fullest};
    ++counters_.packets_flushed;
  }

  /// Sends the packet that waits, to its owner or to the host, if there is a credit; says which way it took.
  Way send() {
    core::expect(waits(), "a packet is sent that waits");
    const nodes::NodeId owner = *waiting_;
    const Way way = way_of(node_->credits(owner, ray_channel) > 0, node_->credits(host_, ray_channel) > 0);
    if (way != Way::wait) {
      send(owner, way);
    }
    return way;
  }

  bool waits() const { return waiting_.has_value(); }
  bool empty() const { return size_ == 0; }
  /// Rays gathered, those of the packet that waits included.
  std::uint32_t size() const { return size_; }
  const Counters& counters() const { return counters_; }

 private:
  static std::size_t stride_bytes(std::uint32_t ray_batch) {
    return core::round_up(ray_packet_bytes(ray_batch), nodes::LocalMemory::alignment);
  }
  static std::size_t room_bytes(const Capacity& capacity) { return capacity.node_count * stride_bytes(capacity.ray_batch); }
  std::span<std::byte> packet_of(nodes::NodeId owner) {
    return room_.subspan(nodes::index_of(owner) * stride_bytes(ray_batch_), ray_packet_bytes(ray_batch_));
  }

  /// Whether an owner has too many of this node's packets for a primary ray to be started.
  bool is_behind(nodes::NodeId owner) const { return owner != host_ && node_->credits(owner, ray_channel) < credits_kept_; }

  void send(nodes::NodeId owner, Way way) {
    std::uint16_t& count = counts_[nodes::index_of(owner)];
    const RayPacketHeader header{count, static_cast<std::uint16_t>(nodes::index_of(owner))};
    const std::span<std::byte> packet = packet_of(owner).first(ray_packet_bytes(count));
    std::memcpy(packet.data(), &header, sizeof(header));
    const bool overflows = way == Way::to_host, was_behind = is_behind(owner);
    node_->send_reserved(overflows ? host_ : owner, ray_channel, number_of(overflows ? Kind::overflow : Kind::rays), packet);
    behind_ += !was_behind && is_behind(owner) ? 1 : 0;
    ++counters_.packets;
    counters_.rays += count;
    counters_.packets_overflowed += overflows ? 1 : 0;
    counters_.rays_overflowed += overflows ? count : 0;
    size_ -= count;
    count = 0;
    waiting_.reset();
  }

  nodes::Node* node_;
  nodes::NodeId host_;
  std::uint32_t ray_batch_;
  std::uint32_t credits_kept_;  ///< for rays other than primary ones
  std::span<std::byte> room_;
  std::span<std::uint16_t> counts_;  ///< rays, by owner
  std::uint32_t size_ = 0;
  std::uint32_t behind_ = 0;  ///< owners of which is_behind() is true
  std::optional<nodes::NodeId> waiting_;
  Counters counters_;
};

}  // namespace dmpc::dataflow
