// What a chain of causes was made of.
#pragma once

#include <array>
#include <cstdint>

#include "nodes/node_id.h"
#include "nodes/packet.h"

namespace dmpc::nodes {

/// A moment of a node's program.
struct ProgramPoint {
  NodeId node{};
  std::uint64_t time_ns = 0;
};

/// Nanoseconds along a chain in which each link begins when the one before ends, from the start of a run to some moment: the
/// parts add up to that moment.
struct PathTimes {
  std::uint64_t computing_ns = 0;   ///< operations that programs charged
  std::uint64_t stolen_ns = 0;      ///< others' requests served in the midst of that
  std::uint64_t sending_ns = 0;     ///< of messages
  std::uint64_t travelling_ns = 0;  ///< latency, hops and bytes, and behind messages to the same node
  std::uint64_t links_ns = 0;       ///< waiting for links that other messages held
  std::uint64_t receiving_ns = 0;   ///< of messages
  std::uint64_t serving_ns = 0;     ///< requests that were waited for, by an interrupt
  std::uint64_t messages = 0;       ///< that led from one node to another
  /// The same by the kinds of messages: all but computing and stolen.
  std::array<std::uint64_t, packet_kind_count> by_kind_ns{};

  std::uint64_t total_ns() const {
    return computing_ns + stolen_ns + sending_ns + travelling_ns + links_ns + receiving_ns + serving_ns;
  }
  bool operator==(const PathTimes&) const = default;
};

/// The chain that leads to the end of a run.
struct CriticalPath {
  PathTimes times;
  /// What last led to the end: a program that was at work till then, or whose message was served till then.
  ProgramPoint from;
};

}  // namespace dmpc::nodes
