// The rank of a node, and the mailbox in which packets for nodes elsewhere wait for a frame.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nodes/mailbox.h"

namespace dmpc::nodes {

/// The rank of a node, or of the host, whose index is node_count: blocks keep neighbours together, the host is on rank 0. Each
/// rank has a node if there are at least as many nodes as ranks.
constexpr std::uint32_t rank_of(std::uint32_t index, std::uint32_t node_count, std::uint32_t rank_count) {
  return index == node_count ? 0 : static_cast<std::uint32_t>(std::uint64_t{index} * rank_count / node_count);
}

/// Precedes a packet in the outbox.
using TargetIndex = std::uint32_t;

/// The capacity of an outbox without targets.
inline MailboxCapacity empty_outbox() { return {.small_front_bytes = sizeof(TargetIndex)}; }

/// Adds slots for everything that may be in flight to one more node elsewhere. A packet in flight has a slot in its target's
/// mailbox. So all packets in flight to nodes elsewhere, which may all wait here, need as many as their mailboxes have together.
/// Bytes are committed when they are first written: few of these slots ever are.
inline void add_target(MailboxCapacity& outbox, const MailboxCapacity& mailbox) {
  outbox.small_slots += mailbox.small_slots;
  outbox.bulk_slots += mailbox.bulk_slots;
  outbox.bulk_payload_bytes = std::max(outbox.bulk_payload_bytes, mailbox.bulk_payload_bytes + sizeof(TargetIndex));
}

}  // namespace dmpc::nodes
