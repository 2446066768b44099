// Packets that need not reach their target at once: how many a sender batches, and the credits that this takes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nodes/packet.h"

namespace dmpc::nodes {

/// Packets that may wait at their sender while it has other things to do, all for one target, which is not woken for each.
struct Batching {
  std::uint32_t kinds = 0;    ///< a bit for each kind of packet
  std::uint32_t packets = 1;  ///< batch size, at which the target gets them; the sender has more credits than that
};

/// The maximum number of quanta for which packets wait, some milliseconds: where a packet takes long to fill, its target still
/// gets it, and shows or saves what has arrived.
inline constexpr std::uint32_t batching_quanta_max = 4096;

/// The batching of packets of one kind for this number of credits: the last quarter is for the time in which the target wakes.
constexpr Batching batching_of(PacketKind kind, std::uint32_t credits) {
  return {.kinds = 1U << kind, .packets = std::max(credits * 3 / 4, 1U)};
}

/// The credits of each of `node_count` nodes for packets that may wait, so that their target has about 1,024 slots for all of
/// them; on a modelled machine, which has no wake-ups, two: one packet travels while the next is gathered.
constexpr std::uint32_t batching_credits(std::uint32_t node_count, bool is_modelled) {
  constexpr std::uint32_t least = 4, most = 128, places = 1024;
  return is_modelled ? 2 : std::clamp(places / node_count, least, most);
}

}  // namespace dmpc::nodes
