// What one of several ranks sets aside for a run, known before it begins.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nodes/ranks/outbox.h"
#include "nodes/ranks/placement.h"
#include "nodes/ranks/rank_links.h"
#include "nodes/ranks/streams_to_ranks.h"

namespace dmpc::nodes {

/// Of one rank, beside its nodes' memories. Sums of what can be under way.
struct NetworkMemory {
  std::size_t outbox_bytes = 0;   ///< for the worst case, of which little is ever written
  std::size_t sent_bytes = 0;     ///< two frames to each other rank
  std::size_t arrived_bytes = 0;  ///< frames that have come
  std::size_t stream_bytes = 0;   ///< what it is sent before the run and has not read yet

  std::size_t total() const { return outbox_bytes + sent_bytes + arrived_bytes + stream_bytes; }
};

/// Of one rank.
struct RankMemory {
  std::uint32_t node_count = 0;
  bool has_host = false;
  std::uint64_t nodes_bytes = 0;  ///< its nodes' local memories, and the host's
  NetworkMemory network;

  std::uint64_t total() const { return nodes_bytes + network.total(); }
};

/// What a rank sets aside for a strategy's plan. Without links there is one, which has all nodes and no network.
template <class Plan>
RankMemory rank_memory(const Plan& plan, const RankLinks* links, std::uint32_t rank) {
  const std::uint32_t node_count = plan.request.computer.node_count, rank_count = links == nullptr ? 1 : links->rank_count();
  RankMemory memory;
  MailboxCapacity outbox = empty_outbox();
  for (std::uint32_t index = 0; index <= node_count; ++index) {
    const bool is_host = index == node_count;
    if (rank_of(index, node_count, rank_count) != rank) {
      add_target(outbox, is_host ? plan.host_mailbox : plan.node_mailbox);
      continue;
    }
    memory.nodes_bytes += (is_host ? plan.host_memory() : plan.node_memory(index)).total();
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
