#include "nodes/node.h"

#include <algorithm>

namespace dmpc::nodes {

Node::Node(NodeId id, std::uint32_t peer_count, LocalMemory& memory, Network& network)
    : id_(id), peer_count_(peer_count), memory_(&memory), network_(&network), credits_(credit_table(peer_count).in(memory)) {
  core::expect(index_of(id) < peer_count && peer_count <= 0x10000, "a node's id fits a packet's header");
}

void Node::grant(NodeId target, Channel channel, std::uint32_t count) {
  std::uint16_t& left = credit(target, channel);
  core::expect(count <= credits_max - left, "credits stay below their limit");
  left = static_cast<std::uint16_t>(left + count);
}

/// Counts the packet that uses the credit, or the refusal.
bool Node::take_credit(NodeId target, Channel channel, PacketKind kind, std::size_t payload_bytes) {
  core::expect(kind < packet_kind_count, "a packet's kind is below the number of kinds");
  std::uint16_t& left = credit(target, channel);
  if (left == 0) {
    ++counters_.refused;
    return false;
  }
  --left;
  counters_.sent[kind].add(payload_bytes);
  return true;
}

bool Node::try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> payload) {
  if (!take_credit(target, channel, kind, payload.size())) {
    return false;
  }
  network_->deliver(target, header_of(kind, payload.size()), payload);
  return true;
}

bool Node::try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> front,
                    std::span<const std::byte> immutable, std::span<std::byte> room) {
  core::expect(room.size() == front.size() + immutable.size(), "a packet has room for its parts, and they fill it");
  if (!take_credit(target, channel, kind, room.size())) {
    return false;
  }
  if (!network_->deliver_in_place(target, header_of(kind, room.size()), front, immutable)) {
    const auto end = std::copy(front.begin(), front.end(), room.begin());
    std::copy(immutable.begin(), immutable.end(), end);
    network_->deliver(target, header_of(kind, room.size()), room);
  }
  return true;
}

}  // namespace dmpc::nodes
