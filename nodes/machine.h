// The model of a machine: its topology, the cost of messages, and the prices of operations.
//
// Source of the message's form: alpha + n * beta + h * tau, as for the circuit-switched machines of the 1990s, with alpha split
// into what occupies the sender, the network's latency and what occupies the receiver (D. Culler and others, "LogP: Towards a
// Realistic Model of Parallel Computation", 1993).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "nodes/charge.h"
#include "nodes/topology.h"

namespace dmpc::nodes {

/// The cost of a message of one class. Times in nanoseconds; rates in picoseconds, summed before they are rounded.
struct MessageCost {
  std::uint64_t send_ns = 0;     ///< the sender's processor is occupied
  std::uint64_t latency_ns = 0;  ///< from the end of that until the message enters the network
  std::uint64_t receive_ns = 0;  ///< the receiver's processor is occupied, regardless of its activity
  std::uint64_t byte_ps = 0;     ///< in the network, per byte of header and payload
};

/// Immutable during a run.
struct Machine {
  std::string name = "ideal";
  TopologyKind topology = TopologyKind::crossbar;
  std::uint32_t uplinks = 1;  ///< per switch of a fat tree, 1 to Topology::uplinks_max; 1 elsewhere
  Switching switching = Switching::circuit;
  std::uint64_t short_bytes_max = 100;  ///< longer messages are of the class long_message
  MessageCost short_message, long_message;
  std::uint64_t hop_ns = 0;                           ///< per link that a message passes
  std::uint64_t service_ns = 0;                       ///< per interrupt, in addition to receiving and sending
  std::array<std::uint64_t, charge_count> cost_ps{};  ///< per operation, by its class
  bool has_contention = true;                         ///< a link carries one message at a time
  /// A node sends one message at a time and receives one at a time, on all of its links. No effect without contention.
  bool has_memory_port = false;
  /// The data structures whose walk cost_ps was measured with or fitted to, a bit each by the program's numbers; 0: not said.
  std::uint32_t prices_for = 0;

  /// The cost of a message of `bytes`, header included.
  const MessageCost& cost_of_message(std::uint64_t bytes) const {
    return bytes <= short_bytes_max ? short_message : long_message;
  }
  /// The price of these operations; modulo 2^64 if it is too large, so that differences are still right.
  std::uint64_t price_ps(const Charges& done) const {
    std::uint64_t sum_ps = 0;
    for (std::size_t i = 0; i < charge_count; ++i) {
      sum_ps += done.count[i] * cost_ps[i];
    }
    return sum_ps;
  }
  /// The price of the operations done from `before` to `after`.
  std::uint64_t price_ps(const Charges& before, const Charges& after) const { return price_ps(after) - price_ps(before); }
  /// A hash of everything that affects a run: every figure and switch and the topology, but not the name or the structures. The
  /// same on every computer.
  std::uint64_t digest() const;
};

}  // namespace dmpc::nodes
