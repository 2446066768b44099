// What the computer counts, always: per node and per kind of packet.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "core/base/counts.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// The traffic of one kind.
struct Traffic {
  std::uint64_t packets = 0;
  std::uint64_t bytes = 0;  ///< header and payload

  /// Counts one packet with this payload.
  void add(std::size_t payload_bytes) {
    ++packets;
    bytes += sizeof(PacketHeader) + payload_bytes;
  }
  Traffic& operator+=(const Traffic& more) { return core::add_counts(*this, more); }
};

/// By kind of packet.
using TrafficByKind = std::array<Traffic, packet_kind_count>;

/// One node's counters of a run. Belongs to the node's thread during the run.
struct NodeCounters {
  TrafficByKind sent{};
  TrafficByKind received{};
  std::uint64_t refused = 0;    ///< try_send without credit
  std::uint64_t quanta = 0;     ///< calls of work()
  std::uint64_t held = 0;       ///< packets delayed by chaos
  std::uint64_t sat_out = 0;    ///< quanta that chaos made the node skip
  std::uint64_t sleeps = 0;     ///< times the node went to sleep
  std::uint64_t busy_ns = 0;    ///< processor time of its thread (threads) or its turns (pool); excludes waits for a core
  std::uint64_t asleep_ns = 0;  ///< wall clock spent asleep for lack of packets
  std::uint64_t wall_ns = 0;    ///< duration of this node's loop; wall - busy - asleep = time waiting for a core or a turn
};

/// The sum over all kinds.
inline Traffic total(const TrafficByKind& traffic) { return core::total_of(traffic, std::identity()); }

}  // namespace dmpc::nodes
