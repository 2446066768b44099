// What the computer counts, always: per node and per kind of packet.
#pragma once

#include <array>
#include <cstdint>

#include "nodes/packet.h"

namespace dmpc::nodes {

struct Traffic {
  std::uint64_t packets = 0;
  std::uint64_t bytes = 0;  ///< header and payload
};

struct NodeCounters {
  std::array<Traffic, packet_kind_count> sent{};
  std::array<Traffic, packet_kind_count> received{};
  std::uint64_t refused = 0;        ///< try_send without credit
  std::uint64_t quanta = 0;         ///< calls of work()
  std::uint64_t sleeps = 0;         ///< times the node's thread went to sleep
  std::uint64_t busy_ns = 0;        ///< wall clock of the threads runner spent in receive() and work(); 0 if not measured
  std::uint64_t wall_ns = 0;        ///< from the start to the end of this node's loop; idle = wall - busy
};

Traffic total(const std::array<Traffic, packet_kind_count>& traffic);

}  // namespace dmpc::nodes
