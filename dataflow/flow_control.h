// The rules that keep rays moving with bounded queues: a node's next task, the way of a packet of rays, and the return of
// credits. Pure functions, shared by the node program and the exhaustive model in tests/dataflow.
//
// Why there is no deadlock:
// (1) A credit of (sender, target) is a slot for one packet of rays in the target's backlog. So everything in flight can be
//     received even by a node that is stuck, and nobody ever waits for a reception.
// (2) A full packet that finds no credit for its owner is queued, and the node goes on. When the queue is full the packet goes to
//     the host. The host has memory for every ray, depends on nobody, and so returns a credit for itself as soon as the packet
//     arrives: a node waits for the host's credit for a bounded time.
// (3) Hence a node with anything to do will do it, its backlog empties, and its credits are returned, batched while it is busy,
//     all of them before it rests. So every queued packet gets its credit, and so does the host: every ray that it buffers goes
//     on. A node may therefore rest with rays that wait for credit, as long as it keeps nobody else's.
// (4) New primary rays start only when nothing received is left and backpressure (admits_primaries()) allows it. A node that
//     holds its primary rays back has queued packets, so by (3) it goes on. No work is taken up while a packet waits: one work()
//     adds at most one ray to a gather, which had a free slot. The packets that the host forwards take the credits of (host,
//     target), with slots of their own.
// (5) With few nodes, every sender has its own credits, which return to it. With many, an owner's slots are shared: a sender asks
//     for one as soon as it has a ray for that owner, and has no second request or unused credit there. A granted credit is for
//     rays that are there, so it is used when their packet is full or its node has nothing else to do, by (3); if they have gone
//     through the host meanwhile, it is returned unused, in the slot that it stands for. So every slot becomes free again, and
//     goes to the longest waiting node: no requester waits for ever. A node asks no more owners at once than it has packets: more
//     could only be those whose rays have gone through the host. Every answer lets it ask another.
// (6) A node that fills as many packets as it has slots for closes one before the next ray, so (2) applies here, too.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/units.h"

namespace dmpc::dataflow {

/// The state of a node, for the choice of the next task.
struct NodeState {
  bool packet_waits = false;      ///< a packet is closed and has found neither credit nor a slot in the queue
  bool is_tracing = false;        ///< a ray is being traced, or a hit has children to be made
  bool has_backlog = false;       ///< received rays
  bool has_primaries = false;     ///< own primary rays that have not started
  bool admits_primaries = false;  ///< by backpressure
  bool can_flush = false;         ///< an open packet has rays and may leave
  bool has_gathered = false;      ///< rays in open or queued packets
  bool is_unanswered = false;     ///< some owner has been asked for a slot and has not granted it yet
  bool is_moving_units = false;   ///< a unit is to be asked for, or a transfer is in progress (units/migration.h)
};

/// In order of priority.
enum class Task : std::uint8_t {
  send_waiting,   ///< try the waiting packet again, and nothing else
  go_on,          ///< with the current ray or hit: depth first
  take_received,  ///< the deepest ray of the backlog
  start_primary,
  flush,  ///< send a packet that is not full: there is no other work
  rest    ///< return all credits owed, pass on the token if passive, wait for a packet
};

/// The number of rays that the host may buffer before nodes hold their primary rays back: some 80 MB.
inline constexpr std::uint32_t host_rays_wanted_max = 1U << 19U;

/// Backpressure: whether a node starts primary rays with `queued` packets in its queue of `capacity`, when the host, by its last
/// answer, buffers `host_rays` rays. Only a node whose queue is nearly full holds back, and only while the host has enough: a hot
/// spot of the picture delays nobody else, and the host's memory stays bounded where primary rays are far more than all queues.
constexpr bool admits_primaries(std::uint32_t queued, std::uint32_t capacity, std::uint64_t host_rays) {
  return capacity == 0 || queued < capacity - capacity / 16 || host_rays < host_rays_wanted_max;
}

/// The next quantum's task.
constexpr Task next_task(const NodeState& state) {
  if (state.packet_waits) {
    return Task::send_waiting;
  }
  if (state.is_tracing) {
    return Task::go_on;
  }
  if (state.has_backlog) {
    return Task::take_received;
  }
  if (state.has_primaries && state.admits_primaries) {
    return Task::start_primary;
  }
  return state.can_flush ? Task::flush : Task::rest;
}

/// Passive in the sense of termination detection: it will not send a ray packet unless it receives one. A node that rests with
/// rays that wait for a credit, or for permission to start, is not.
constexpr bool is_passive(const NodeState& state) {
  return next_task(state) == Task::rest && !state.has_primaries && !state.has_gathered && !state.is_unanswered &&
         !state.is_moving_units;
}

/// The destination of a packet of rays.
enum class Way : std::uint8_t {
  to_owner,
  to_queue,  ///< at the sender, until the owner returns a credit
  to_host,   ///< overflow: the host buffers it and forwards it when it has a credit for the owner
  wait       ///< until a packet brings any credit
};

/// Depends only on the sender's own credits and queue, so the answer is the same under every runner.
constexpr Way way_of(bool has_owner_credit, bool has_queue_room, bool has_host_credit) {
  if (has_owner_credit) {
    return Way::to_owner;
  }
  if (has_queue_room) {
    return Way::to_queue;
  }
  return has_host_credit ? Way::to_host : Way::wait;
}

/// The number of credits that a busy node collects for one sender before it returns them: half, so that the sender can go on
/// meanwhile.
constexpr std::uint32_t return_batch(std::uint32_t credits_each) { return std::max(1U, credits_each / 2); }

/// Whether a node that owes a sender `owed` credits returns them all now. A resting node keeps none: the host may be waiting for
/// them with rays for it.
constexpr bool returns_credits(std::uint32_t owed, std::uint32_t batch, bool rests) {
  return owed > 0 && (rests || owed >= batch);
}

/// Whether a node closes a packet that is not full: as many are being filled as there are slots, and the next ray may need one
/// more.
constexpr bool must_close(std::uint32_t open_packets, std::uint32_t open_packets_max) { return open_packets == open_packets_max; }

/// Whether a node asks an owner for a shared slot: there are rays for it, being gathered or in a closed packet.
constexpr bool asks(bool has_rays, bool has_credit, bool has_asked) { return has_rays && !has_credit && !has_asked; }

/// Whether it may ask one more, with `asked` unanswered requests: their answers have slots in its mailbox.
constexpr bool may_ask(std::uint32_t asked, std::uint32_t asks_max) { return asked < asks_max; }

/// Whether a granted shared slot is returned unused: all rays for that owner have gone through the host.
constexpr bool declines(bool has_rays, bool has_credit) { return has_credit && !has_rays; }

/// Whether an owner grants one of its shared slots to the longest waiting node.
constexpr bool grants(std::uint32_t free_slots, bool is_asked) { return free_slots > 0 && is_asked; }

/// The number of slots, of those in which `packets` packets came, that are free again, with `rays` of their rays still here.
constexpr std::uint32_t slots_freed(std::uint32_t packets, std::uint32_t rays, std::uint32_t ray_batch) {
  return packets - core::ceil_divide(rays, ray_batch);
}

/// Whether the host forwards a packet of the `kept` rays that it buffers for one owner: only into a free slot.
constexpr bool forwards(std::uint64_t kept, bool has_owner_credit) { return kept > 0 && has_owner_credit; }

/// The host is passive in the sense of termination detection while it buffers no ray.
constexpr bool host_is_passive(std::uint64_t kept) { return kept == 0; }

}  // namespace dmpc::dataflow
