// A node's network under chaos: packets that it sends wait in its own memory for a drawn number of its quanta.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "nodes/chaos.h"
#include "nodes/local_memory.h"
#include "nodes/node.h"

namespace dmpc::nodes {

/// A bounded queue between one node and the network. Packets to one target arrive in order; those to different targets may not.
/// Nothing is refused or lost: if there is no space for a new packet the oldest ones leave early. A delayed packet has spent its
/// credit, so its target has a slot for it at any time. Thread safety: belongs to the sender's thread.
class DelayedPackets final : public Network {
 public:
  /// Takes `room_bytes` of `memory` (Category::queues). `network` outlives this.
  DelayedPackets(const Chaos& chaos, NodeId source, LocalMemory& memory, std::size_t room_bytes, Network& network);

  /// Memory for four packets with the largest payload that the node sends and sixteen small ones, in bytes; and the local memory
  /// that it takes.
  static std::size_t room_bytes(std::size_t payload_bytes_max);

  /// Passes the packet on at once or delays it, at random. Expects that the memory is enough for it alone.
  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override;

  /// To be called after each quantum of the node: passes on what has waited long enough.
  void pass_quantum();

  /// Whether no packet is delayed.
  bool empty() const { return used_bytes_ == 0; }
  /// Number of packets that have been delayed so far.
  std::uint64_t count() const { return count_; }

 private:
  /// Precedes a payload that is delayed; the memory holds a sequence of both, oldest first.
  struct Held {
    std::uint64_t due_quantum = 0;
    NodeId target{};
    PacketHeader header;

    /// Including its payload.
    std::size_t bytes() const { return bytes_for(header.bytes); }
  };
  static std::size_t bytes_for(std::size_t payload_bytes);

  Held held_at(std::size_t offset) const;
  /// The due time of the last delayed packet for `target`; 0 without one.
  std::uint64_t last_due_quantum(NodeId target) const;
  void append(const Held& held, std::span<const std::byte> payload);
  void hand_on(std::size_t offset);
  void hand_on_oldest();

  ChaosDelays delays_;
  Network* network_;
  std::span<std::byte> room_;
  std::size_t used_bytes_ = 0;
  std::uint64_t quantum_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace dmpc::nodes
