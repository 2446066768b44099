// The wires of a modelled machine, each with the time at which it is free again.
#pragma once

#include <cstdint>
#include <vector>

#include "nodes/topology.h"

namespace dmpc::nodes {

/// What the links of a run have carried.
struct LinkTraffic {
  std::uint64_t messages = 0;
  std::uint64_t hops = 0;     ///< links passed, summed over messages
  std::uint64_t wait_ns = 0;  ///< that messages stood before links that others held, summed
};

/// Circuit switching: a message reserves every link of its route for the whole time of its passage and waits until all are free.
/// The host hangs on node 0 by a link of its own in each direction. Deterministic; belongs to one run.
class Links {
 public:
  /// Without contention every message finds its links free.
  Links(const Topology& topology, bool has_contention);

  /// The host is node topology.node_count().
  std::uint32_t hops(NodeId source, NodeId target) const;
  /// Sends a message into the network at `now_ns` that needs `passage_ns` from its first to its last byte: when it has arrived. A
  /// message from a node to itself passes no link and arrives at once.
  std::uint64_t pass(NodeId source, NodeId target, std::uint64_t now_ns, std::uint64_t passage_ns);

  const LinkTraffic& traffic() const { return traffic_; }
  /// The time that the busiest link was held.
  std::uint64_t busiest_ns() const;

 private:
  struct Wire {
    std::uint32_t to = 0;
    std::uint64_t free_at_ns = 0;
    std::uint64_t held_ns = 0;
  };

  Wire& wire(const Link& link);
  void find_route(NodeId source, NodeId target);

  Topology topology_;
  bool has_contention_;
  std::vector<std::vector<Wire>> wires_;  ///< by the place where they begin; the host's place is the last
  std::vector<Link> links_;               ///< of the message that is passing
  std::vector<Wire*> route_;              ///< the same links' wires
  LinkTraffic traffic_;
};

}  // namespace dmpc::nodes
