// What a seed does to the computer: how long packets are held back, which nodes and links are slow, how few credits there are.
//
// Only the draws are here, free of clocks and threads; a runner decides what a quantum of delay is. Nothing is drawn from the
// time or the order of threads: each node has a stream for each purpose, which depends on the seed and its id alone.
#pragma once

#include <cstdint>

#include "core/base/sampling.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// How badly a computer behaves. Any values are legal: what a run comes to and the laws of conservation survive all of them.
struct Chaos {
  std::uint64_t seed = 0;
  std::uint32_t held_percent = 50;      ///< of the packets are held back, 0 to 100
  std::uint32_t delay_quanta_max = 16;  ///< a packet held back waits 1 to this many of its sender's quanta, 1 to 2^16
  std::uint32_t slow_link_percent = 0;  ///< of the sender-target pairs are slow, 0 to 100
  std::uint32_t slow_link_factor = 8;   ///< times the delay on a slow link, 1 to 2^15
  std::uint32_t slow_node_percent = 0;  ///< of the nodes are slow, 0 to 100
  std::uint32_t idle_quanta_max = 16;   ///< a slow node sits out 0 to this many quanta before each that it runs, below 2^31
  bool shrinks_credits = true;          ///< each kind of credit is drawn anew, from 1 to what was planned
};

/// The settings that a seed stands for. Different seeds make different kinds of trouble: many packets late by little, few by
/// much, slow links, slow nodes.
Chaos chaos_of(std::uint64_t seed);

/// A sequence of numbers that depends on its key alone: a counter put through a hash.
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

/// The credits that are left of `planned`: 1 to `planned`, the few more often than the many; 0 stays 0. `kind` tells credits of
/// different use apart, by a numbering of the strategy's own. All nodes draw the same.
std::uint32_t shrunk_credits(const Chaos& chaos, std::uint32_t planned, std::uint32_t kind);

/// Whether the way from `source` to `target` is slow, for the whole run.
bool is_slow_link(const Chaos& chaos, NodeId source, NodeId target);

/// Whether a node is slow, for the whole run.
bool is_slow_node(const Chaos& chaos, NodeId node);

/// How long a node's packets are held back. Thread safety: none; belongs to the node.
class ChaosDelays {
 public:
  ChaosDelays(const Chaos& chaos, NodeId source);
  /// The quanta that the next packet, to `target`, is held back; 0 for not at all. Call it once for each packet sent.
  std::uint32_t next_quanta(NodeId target);

 private:
  Chaos chaos_;
  NodeId source_;
  ChaosStream draws_;
};

/// How long a node pauses. Thread safety: none; belongs to the node.
class ChaosPauses {
 public:
  ChaosPauses(const Chaos& chaos, NodeId node);
  /// The quanta that the node sits out before the next that it runs. Call it once for each quantum run.
  std::uint32_t next_quanta();

 private:
  std::uint32_t quanta_max_;  ///< 0 for a node that is not slow
  ChaosStream draws_;
};

}  // namespace dmpc::nodes
