#include "nodes/node.h"

namespace dmpc::nodes {

std::size_t credit_table_bytes(std::uint32_t peer_count) {
  return LocalMemory::bytes_for<std::uint16_t>(peer_count * channel_count);
}

Node::Node(NodeId id, std::uint32_t peer_count, LocalMemory& memory, Network& network)
    : id_(id),
      peer_count_(peer_count),
      memory_(&memory),
      network_(&network),
      credits_(memory.allocate<std::uint16_t>(Category::queues, peer_count * channel_count)) {
  core::expect(index_of(id) < peer_count && peer_count <= 0x10000, "a node's id fits a packet's header");
}

void Node::grant(NodeId target, Channel channel, std::uint32_t count) {
  std::uint16_t& left = credit(target, channel);
  core::expect(count <= credits_max - left, "credits stay below their limit");
  left = static_cast<std::uint16_t>(left + count);
}

bool Node::try_send(NodeId target, Channel channel, PacketKind kind, std::span<const std::byte> payload) {
  core::expect(kind < packet_kind_count, "a packet's kind is below the number of kinds");
  std::uint16_t& left = credit(target, channel);
  if (left == 0) {
    ++counters_.refused;
    return false;
  }
  --left;
  counters_.sent[kind].add(payload.size());
  const PacketHeader header{
      .bytes = static_cast<std::uint32_t>(payload.size()), .source = static_cast<std::uint16_t>(index_of(id_)), .kind = kind};
  network_->deliver(target, header, payload);
  return true;
}

}  // namespace dmpc::nodes
