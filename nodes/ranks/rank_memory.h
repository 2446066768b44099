// The memory of one of several ranks for a run, known before it begins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ranges.h"
#include "nodes/ranks/outbox.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/streams.h"
#include "nodes/runner.h"

namespace dmpc::nodes {

/// A rank's memory in addition to its nodes' memories: sums of what can be in flight.
struct NetworkMemory {
  std::size_t outbox_bytes = 0;   ///< for the worst case; little is ever written
  std::size_t sent_bytes = 0;     ///< two frames to each other rank
  std::size_t arrived_bytes = 0;  ///< frames that have come
  std::size_t stream_bytes = 0;   ///< stream bytes that it is sent before the run and has not read yet

  std::size_t total() const { return outbox_bytes + sent_bytes + arrived_bytes + stream_bytes; }
};

/// All memory of one rank.
struct RankMemory {
  std::uint32_t node_count = 0;
  bool has_host = false;
  std::uint64_t nodes_bytes = 0;  ///< its nodes' local memories, and the host's
  NetworkMemory network;

  std::uint64_t total() const { return nodes_bytes + network.total(); }
};

/// The memory of a node, or of the host.
struct PeerMemory {
  MailboxCapacity mailbox;
  std::size_t bytes = 0;  ///< all of its local memory, the mailbox included
};

/// The memories of all nodes of a strategy's plan, then the host's.
template <class Plan>
requires requires(const Plan& plan) { plan.node_mailbox; }
std::vector<PeerMemory> peers_of(const Plan& plan) {
  std::vector<PeerMemory> peers;
  for (std::uint32_t node = 0; node < plan.request.computer.node_count; ++node) {
    peers.push_back({plan.node_mailbox, plan.node_memory(node).total()});
  }
  peers.push_back({plan.host_mailbox, plan.host_memory().total()});
  return peers;
}
/// The memories of all nodes from a runner's specifications, then the host's.
inline std::vector<PeerMemory> peers_of(std::span<const NodeSpecification> specifications) {
  return core::mapped<PeerMemory>(specifications, [&](const NodeSpecification& specification) {
    return PeerMemory{specification.mailbox, specification.plan.total()};
  });
}

/// A rank's memory. Without links there is one rank, which has all nodes and no network.
inline RankMemory rank_memory(std::span<const PeerMemory> peers, const RankLinks* links, std::uint32_t rank) {
  const auto node_count = static_cast<std::uint32_t>(peers.size() - 1);
  const std::uint32_t rank_count = links == nullptr ? 1 : links->rank_count();
  RankMemory memory;
  MailboxCapacity outbox = empty_outbox();
  for (std::uint32_t index = 0; index <= node_count; ++index) {
    if (rank_of(index, node_count, rank_count) != rank) {
      add_target(outbox, peers[index].mailbox);
      continue;
    }
    const bool is_host = index == node_count;
    memory.nodes_bytes += peers[index].bytes;
    memory.node_count += is_host ? 0 : 1;
    memory.has_host = memory.has_host || is_host;
  }
  if (links != nullptr) {
    memory.network = {.outbox_bytes = outbox.bytes(),
                      .sent_bytes = links->room_bytes(),
                      .arrived_bytes = links->arrival_bytes(),
                      .stream_bytes = rank == 0 ? 0 : stream_window_bytes};
  }
  return memory;
}

}  // namespace dmpc::nodes
