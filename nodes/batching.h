// Packets that need not reach their target at once: how many a sender keeps back, and the credits that this takes.
#pragma once

#include <algorithm>
#include <cstdint>

#include "nodes/packet.h"

namespace dmpc::nodes {

/// Packets that may wait at their sender while it has other things to do, all for one target, which is not woken for each.
struct Batching {
  std::uint32_t kinds = 0;    ///< a bit for each
  std::uint32_t packets = 1;  ///< at so many the target gets them; the sender's credits last longer than that
};

/// Quanta for which packets wait at most, some milliseconds: where a packet takes long to fill, its target hears of it none the
/// less, and shows or keeps what has come.
inline constexpr std::uint32_t batching_quanta_max = 4096;

/// The patience with packets of one kind for which a sender has so many credits: the last quarter lasts while the target wakes.
constexpr Batching batching_of(PacketKind kind, std::uint32_t credits) {
  return {.kinds = 1U << kind, .packets = std::max(credits * 3 / 4, 1U)};
}

/// The credits of each of so many nodes for packets that may wait, as far as their target has some 1,024 places for those of all;
/// on a modelled machine, which knows no wake-ups, two: one packet travels while the next is gathered.
constexpr std::uint32_t batching_credits(std::uint32_t node_count, bool is_modelled) {
  constexpr std::uint32_t least = 4, most = 128, places = 1024;
  return is_modelled ? 2 : std::clamp(places / node_count, least, most);
}

}  // namespace dmpc::nodes
