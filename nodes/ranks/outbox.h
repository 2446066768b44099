// Where a rank's packets for nodes elsewhere wait for a frame.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nodes/mailbox.h"

namespace dmpc::nodes {

/// Before a packet in the outbox.
using TargetIndex = std::uint32_t;

/// The capacity of an outbox for nobody yet.
inline MailboxCapacity empty_outbox() { return {.small_front_bytes = sizeof(TargetIndex)}; }

/// Makes room for all that may be under way to one more node elsewhere. A packet under way has a place in its target's mailbox.
/// So what is under way to nodes elsewhere, all of which may wait here, has as many as their mailboxes have together. Bytes are
/// set aside when they are first written: of these places few ever are.
inline void add_target(MailboxCapacity& outbox, const MailboxCapacity& mailbox) {
  outbox.small_slots += mailbox.small_slots;
  outbox.bulk_slots += mailbox.bulk_slots;
  outbox.bulk_payload_bytes = std::max(outbox.bulk_payload_bytes, mailbox.bulk_payload_bytes + sizeof(TargetIndex));
}

}  // namespace dmpc::nodes
