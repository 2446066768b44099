// All that a node program can touch of the computer: its id, its local memory, try_send, and its counters.
#pragma once

#include <cstdint>
#include <span>

#include "nodes/counters.h"
#include "nodes/local_memory.h"
#include "nodes/node_id.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// A class of packets with credits of its own: a program's numbering, below channel_count. Packets of one channel are all small or
/// all bulk.
using Channel = std::uint8_t;
inline constexpr std::size_t channel_count = 4;

/// What a runner does with a packet that its sender may send: carries it to the target's mailbox. Never refuses: credits made room.
class Network {
 public:
  virtual ~Network() = default;
  virtual void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) = 0;
};

/// One processor. Not thread-safe: belongs to the thread that runs its program.
class Node {
 public:
  /// `peer_count` = nodes + host. The table of credits (peer_count * channel_count * 2 bytes) is taken from `memory`.
  Node(NodeId id, std::uint32_t peer_count, LocalMemory& memory, Network& network);

  NodeId id() const;
  std::uint32_t peer_count() const;
  LocalMemory& memory();
  NodeCounters& counters();

  /// Gives this node the right to have `count` more packets of `channel` under way to `target`: at the set-up, and whenever the program
  /// learns (by a reply, an acknowledgement) that one of its packets has been taken from the target's mailbox.
  void grant(NodeId target, Channel channel, std::uint32_t count = 1);
  std::uint32_t credits(NodeId target, Channel channel) const;

  /// Sends if a credit for (target, channel) is left and spends it; else refuses: keep the packet in a bounded queue of your own
  /// and go on receiving. A node may send to itself.
  [[nodiscard]] bool try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> payload);

  /// The same for a trivially copyable value.
  template <class T>
  [[nodiscard]] bool try_send(NodeId target, Channel channel, PacketKind kind, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return try_send(target, channel, kind, std::as_bytes(std::span(&value, 1)));
  }
  /// Sends a packet whose place is reserved by the protocol (a reply): expects that a credit is left.
  template <class T>
  void send_reserved(NodeId target, Channel channel, PacketKind kind, const T& value) {
    core::expect(try_send(target, channel, kind, value), "a reply always has room");
  }

 private:
  std::uint16_t& credit(NodeId target, Channel channel) const;

  NodeId id_;
  std::uint32_t peer_count_;
  LocalMemory* memory_;
  Network* network_;
  NodeCounters counters_;
  std::span<std::uint16_t> credits_;
};

}  // namespace dmpc::nodes
