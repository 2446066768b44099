// The parts of a node's virtual time, which add up to the whole.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "core/base/sampling.h"
#include "nodes/observer.h"
#include "nodes/packet.h"
#include "nodes/virtual/links.h"

namespace dmpc::nodes {

/// The times of one node in one run, in nanoseconds of virtual time.
struct VirtualTimes {
  std::uint64_t computing_ns = 0;     ///< the operations that the program charged
  std::uint64_t sending_ns = 0;       ///< sending packets, except those sent by an interrupt's service
  std::uint64_t receiving_ns = 0;     ///< receiving packets, except those that interrupted
  std::uint64_t service_busy_ns = 0;  ///< service of interrupts while the program had something to do
  std::uint64_t service_idle_ns = 0;  ///< service of interrupts while it had nothing to do
  /// Idle time, by the kind of the packet that ended it.
  std::array<std::uint64_t, packet_kind_count> waiting_ns{};
  std::uint64_t end_ns = 0;  ///< idle time at the end

  /// Everything but waiting.
  std::uint64_t busy_ns() const { return computing_ns + sending_ns + receiving_ns + service_busy_ns + service_idle_ns; }
  /// The length of the run: the same for every node.
  std::uint64_t total_ns() const {
    return busy_ns() + std::accumulate(waiting_ns.begin(), waiting_ns.end(), std::uint64_t{0}) + end_ns;
  }
};

/// Enough for all links of machines with up to 32 nodes, usually.
inline constexpr std::size_t busiest_links_max = 256;

/// The result of a run in virtual time.
struct VirtualReport {
  std::uint64_t total_ns = 0;  ///< from the start to the last event
  std::uint64_t events = 0;
  /// Over all events in order: time, source and kind, and for a message its target, kind and bytes.
  std::uint64_t hash = 0;
  std::uint64_t machine_digest = 0;  ///< Machine::digest()
  LinkTraffic links;
  std::size_t links_used = 0;                      ///< number that carried anything, including memory ports
  std::vector<LinkUse> busiest_links;              ///< as Links::busiest(), at most busiest_links_max
  std::vector<VirtualTimes> nodes;                 ///< in order, the host last
  std::optional<CriticalPath> critical_path = {};  ///< if an observer followed paths; adds up to total_ns

  /// The share of the run in which the host was busy, in [0, 1]; 0 for a run without nodes or time.
  double host_busy_share() const {
    return nodes.empty() || total_ns == 0 ? 0 : static_cast<double>(nodes.back().busy_ns()) / static_cast<double>(total_ns);
  }
  /// A digest of a whole run: its events, its machine and its product (a hash of it). Equal runs have equal hashes, on any
  /// computer and in every build type.
  std::uint64_t run_hash(std::uint64_t product_hash) const { return core::mix(core::mix(hash ^ machine_digest) ^ product_hash); }
};

}  // namespace dmpc::nodes
