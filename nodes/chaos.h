// Disturbances by a seed: how long packets are delayed, which nodes and links are slow, how few credits there are.
//
// This file only draws random numbers, without clocks and threads; a runner decides what a quantum of delay is. Nothing depends
// on time or the order of threads: each node has a stream for each purpose, which depends on the seed and its id alone.
#pragma once

#include <cstdint>

#include "core/base/sampling.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// Settings of the disturbances. Any values are legal: the result of a run and the conservation laws hold with all of them.
struct Chaos {
  std::uint64_t seed = 0;
  std::uint32_t held_percent = 50;      ///< share of packets that are delayed, 0 to 100
  std::uint32_t delay_quanta_max = 16;  ///< a delayed packet waits 1 to this many of its sender's quanta, 1 to 2^16
  std::uint32_t slow_link_percent = 0;  ///< share of sender-target pairs that are slow, 0 to 100
  std::uint32_t slow_link_factor = 8;   ///< factor of the delay on a slow link, 1 to 2^15
  std::uint32_t slow_node_percent = 0;  ///< share of nodes that are slow, 0 to 100
  std::uint32_t idle_quanta_max = 16;   ///< a slow node skips 0 to this many quanta before each that it runs, below 2^31
  bool shrinks_credits = true;          ///< each kind of credit is drawn again, from 1 to the planned number
};

/// The settings for a seed. Different seeds cause different kinds of disturbance: many short delays, few long ones, slow links,
/// slow nodes.
Chaos chaos_of(std::uint64_t seed);

/// A random sequence that depends on its key alone: a hashed counter.
class ChaosStream {
 public:
  explicit constexpr ChaosStream(std::uint64_t key) : state_(key) {}

  /// Below `count`, which is above 0.
  constexpr std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((core::mix(state_ += 0x9e3779b97f4a7c15ULL) >> 32U) * count) >> 32U);
  }
  /// True `percent` times in a hundred.
  constexpr bool chance(std::uint32_t percent) { return below(100) < percent; }

 private:
  std::uint64_t state_;
};

/// The credits that are left of `planned`: 1 to `planned`, small numbers more often than large ones; 0 stays 0. `kind`
/// distinguishes credits of different use, in the strategy's numbering. All nodes draw the same.
std::uint32_t shrunk_credits(const Chaos& chaos, std::uint32_t planned, std::uint32_t kind);

/// Whether the way from `source` to `target` is slow, for the whole run.
bool is_slow_link(const Chaos& chaos, NodeId source, NodeId target);

/// Whether a node is slow, for the whole run.
bool is_slow_node(const Chaos& chaos, NodeId node);

/// A node's packet delays. Not thread-safe; belongs to the node.
class ChaosDelays {
 public:
  ChaosDelays(const Chaos& chaos, NodeId source);
  /// The quanta by which the next packet, to `target`, is delayed; 0 for none. Call it once for each packet sent.
  std::uint32_t next_quanta(NodeId target);

 private:
  Chaos chaos_;
  NodeId source_;
  ChaosStream draws_;
};

/// A node's pauses. Not thread-safe; belongs to the node.
class ChaosPauses {
 public:
  ChaosPauses(const Chaos& chaos, NodeId node);
  /// The quanta that the node skips before the next that it runs. Call it once for each quantum run.
  std::uint32_t next_quanta();

 private:
  std::uint32_t quanta_max_;  ///< 0 for a node that is not slow
  ChaosStream draws_;
};

}  // namespace dmpc::nodes
