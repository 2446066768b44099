// The wires of a modelled machine, each with the time at which it is free again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/machine.h"
#include "nodes/topology.h"

namespace dmpc::nodes {

/// What one link has carried. A node's memory port counts as a link each way, between the node's memory and the node.
struct LinkUse {
  std::string from, to;        ///< "node 3", "host", "switch 0", "place 9" (a router without a node), "memory 3"
  std::uint64_t messages = 0;  ///< that passed it
  std::uint64_t bytes = 0;     ///< of them, headers included
  std::uint64_t busy_ns = 0;   ///< held by them
  std::uint64_t wait_ns = 0;   ///< that messages waited for it
};

/// What the links of a run have carried together.
struct LinkTraffic {
  std::uint64_t messages = 0;  ///< from a node to another one
  std::uint64_t hops = 0;      ///< links passed, memory ports aside, summed over messages
  std::uint64_t passages = 0;  ///< links and memory ports passed, summed over messages
  std::uint64_t bytes = 0;     ///< of the messages, summed over passages
  std::uint64_t busy_ns = 0;   ///< of the links and memory ports, summed
  std::uint64_t wait_ns = 0;   ///< that messages stood before links that others held, summed
};

/// A message takes one link of its route after the other, and holds them as the machine's Switching says. Links are given in the
/// order in which messages enter the network. The host hangs on node 0 by a link of its own in each direction. If the machine has
/// memory ports, every node but the host, whose only link is one, has one in each direction: the first and the last link of a
/// route. Without contention nothing is ever waited for. Deterministic; belongs to one run.
class Links {
 public:
  /// `node_count` is without the host, at least 1.
  Links(const Machine& machine, std::uint32_t node_count);

  /// Links of the way, without memory ports. The host is node `node_count`.
  std::uint32_t hops(NodeId source, NodeId target) const;
  /// Sends a message of so many bytes into the network at `now_ns`: when it has arrived. From its first byte to its last it takes
  /// the machine's hop_ns for each hop and its byte_ps for each byte, and what it waits on its way. A message from a node to
  /// itself passes no link and arrives at once.
  std::uint64_t pass(NodeId source, NodeId target, std::uint64_t now_ns, std::uint64_t bytes);

  const LinkTraffic& traffic() const { return traffic_; }
  /// At most `count` of the links that carried anything: those that were held longest, the longest first, equal ones in the order
  /// of their ends.
  std::vector<LinkUse> busiest(std::size_t count) const;
  /// How many links and memory ports carried anything.
  std::size_t used_count() const;
  /// Expects that what the links carried adds up to traffic().
  void expect_sums() const;

 private:
  struct Wire {
    Link link;
    std::uint64_t free_at_ns = 0;
    std::uint64_t messages = 0, bytes = 0, busy_ns = 0, wait_ns = 0;
  };

  std::uint32_t host_place() const { return topology_.place_count(); }
  std::uint32_t memory_place(std::uint32_t node) const { return host_place() + 1 + node; }
  std::string place_name(std::uint32_t place) const;
  std::uint32_t wire_of(const Link& link);
  std::size_t place_in_table(const Link& link) const;
  void grow_table();
  void find_route(NodeId source, NodeId target);
  std::uint64_t pass_along_route(std::uint64_t now_ns, std::uint64_t bytes, std::uint64_t bytes_ns);
  std::uint64_t hop_ns(const Link& link) const;
  std::uint64_t start_ns(Wire& wire, std::uint64_t now_ns);
  void hold(Wire& wire, std::uint64_t from_ns, std::uint64_t busy_ns, std::uint64_t bytes);

  Topology topology_;
  Machine machine_;
  std::vector<Wire> wires_;               ///< of links that a message has passed, in the order of the first
  std::vector<std::uint32_t> table_;      ///< of a power of two: by a hash of its ends, where each wire is, or no_wire
  std::vector<Link> links_;               ///< of the message that is passing, memory ports included
  std::vector<std::uint32_t> route_;      ///< the same links' wires
  std::vector<std::uint64_t> begins_ns_;  ///< from when on it has each of them
  LinkTraffic traffic_;
};

}  // namespace dmpc::nodes
