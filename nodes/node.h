// Everything of the computer that a node program can use: its id, its local memory, try_send, and its counters.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/base/expect.h"
#include "nodes/counters.h"
#include "nodes/layout.h"
#include "nodes/local_memory.h"
#include "nodes/node_id.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// A class of packets with its own credits: a program's numbering, below channel_count. Packets of one channel are all small or
/// all bulk.
using Channel = std::uint8_t;
inline constexpr std::size_t channel_count = 4;
/// The maximum number of credits of one node for one target and channel.
inline constexpr std::uint32_t credits_max = 0xFFFF;

/// Types that may be sent as a value: trivially copyable, and not a view of bytes elsewhere.
template <class T>
concept PacketValue = std::is_trivially_copyable_v<T> && !std::convertible_to<const T&, std::span<const std::byte>>;

/// How a runner delivers a packet that its sender may send to the target's mailbox. Never refuses: credits guarantee a slot.
class Network {
 public:
  virtual ~Network() = default;
  /// Copies the packet into the mailbox of `target`, on the sender's thread.
  virtual void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) = 0;
  /// Delivers a payload with an immutable end by its address. Returns false, without delivering, if this network carries only
  /// bytes.
  virtual bool deliver_in_place(NodeId /*target*/, const PacketHeader& /*header*/, std::span<const std::byte> /*front*/,
                                std::span<const std::byte> /*immutable*/) {
    return false;
  }
};

/// The memory of a Node's table of credits.
inline Room<std::uint16_t> credit_table(std::uint32_t peer_count) { return {Category::queues, peer_count * channel_count}; }

/// One processor. Not thread-safe: belongs to the thread that runs its program.
class Node {
 public:
  /// `peer_count` = nodes + host. credit_table() is taken from `memory`.
  Node(NodeId id, std::uint32_t peer_count, LocalMemory& memory, Network& network);

  /// Its own name.
  NodeId id() const { return id_; }
  /// The number of processors, including the host and this one: ids are 0 .. peer_count() - 1.
  std::uint32_t peer_count() const { return peer_count_; }
  /// The only memory that its program may allocate from, until it is sealed.
  LocalMemory& memory() { return *memory_; }
  /// Its counters of the run.
  NodeCounters& counters() { return counters_; }

  /// Gives this node the right to have `count` more packets of `channel` in flight to `target`: at the set-up, and whenever the
  /// program learns (by a reply or an acknowledgement) that one of its packets has been taken from the target's mailbox. The
  /// total is at most credits_max.
  void grant(NodeId target, Channel channel, std::uint32_t count = 1);
  /// The credits left.
  std::uint32_t credits(NodeId target, Channel channel) const { return credit(target, channel); }

  /// Sends if a credit for (target, channel) is left and spends it; otherwise refuses: keep the packet in a bounded queue of your
  /// own and go on receiving. A node may send to itself.
  [[nodiscard]] bool try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> payload);

  /// Tries to send a payload of `front` and then `immutable`, bytes that never change and outlive the run. They are concatenated
  /// in `room`, which has their length, unless the runner delivers `immutable` by address; both count the same.
  [[nodiscard]] bool try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> front,
                              std::span<const std::byte> immutable, std::span<std::byte> room);

  /// Tries to send a trivially copyable value.
  template <PacketValue T>
  [[nodiscard]] bool try_send(NodeId target, Channel channel, PacketKind kind, const T& value) {
    return try_send(target, channel, kind, std::as_bytes(std::span(&value, 1)));
  }
  /// Sends a packet whose slot is reserved by the protocol (a reply): expects that a credit is left.
  void send_reserved(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> payload) {
    core::expect(try_send(target, channel, kind, payload), "a reply always has room");
  }
  /// Sends a trivially copyable value in a reserved slot.
  template <PacketValue T>
  void send_reserved(NodeId target, Channel channel, PacketKind kind, const T& value) {
    send_reserved(target, channel, kind, std::as_bytes(std::span(&value, 1)));
  }

 private:
  bool take_credit(NodeId target, Channel channel, PacketKind kind, std::size_t payload_bytes);
  PacketHeader header_of(PacketKind kind, std::size_t payload_bytes) const {
    return {
        .bytes = static_cast<std::uint32_t>(payload_bytes), .source = static_cast<std::uint16_t>(index_of(id_)), .kind = kind};
  }
  std::uint16_t& credit(NodeId target, Channel channel) const {
    core::expect(index_of(target) < peer_count_ && channel < channel_count, "a packet has a target and a channel that exist");
    return credits_[index_of(target) * channel_count + channel];
  }

  NodeId id_;
  std::uint32_t peer_count_;
  LocalMemory* memory_;
  Network* network_;
  NodeCounters counters_;
  std::span<std::uint16_t> credits_;
};

}  // namespace dmpc::nodes
