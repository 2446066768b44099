// Where a node's virtual time has gone: the parts add up to the whole.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "nodes/links.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// Of one node in one run, in nanoseconds of virtual time.
struct VirtualTimes {
  std::uint64_t computing_ns = 0;  ///< the operations that the program charged
  std::uint64_t sending_ns = 0;    ///< of packets, but for those sent by an interrupt's service
  std::uint64_t receiving_ns = 0;  ///< of packets, but for those that interrupted
  std::uint64_t stolen_ns = 0;     ///< service of interrupts while the program had something to do
  std::uint64_t lent_ns = 0;       ///< the same while it had nothing to do
  /// Nothing to do, by the kind of the packet that ended it.
  std::array<std::uint64_t, packet_kind_count> waiting_ns{};
  std::uint64_t end_ns = 0;  ///< nothing to do any more

  /// The length of the run: the same for every node.
  std::uint64_t total_ns() const {
    return computing_ns + sending_ns + receiving_ns + stolen_ns + lent_ns +
           std::accumulate(waiting_ns.begin(), waiting_ns.end(), std::uint64_t{0}) + end_ns;
  }
};

/// What a run came to in virtual time.
struct VirtualReport {
  std::uint64_t total_ns = 0;  ///< from the start to the last event
  std::uint64_t events = 0;
  std::uint64_t hash = 0;  ///< over (time, source, kind) of all events
  LinkTraffic links;
  std::uint64_t busiest_link_ns = 0;
  std::vector<VirtualTimes> nodes;  ///< in order, the host last
};

}  // namespace dmpc::nodes
