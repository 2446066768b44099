// The links of a modelled machine, each with the time at which it is free again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/machine.h"
#include "nodes/topology.h"

namespace dmpc::nodes {

/// The traffic of one link. A node's memory port counts as a link in each direction, between the node's memory and the node.
struct LinkUse {
  std::string from, to;        ///< "node 3", "host", "switch 0", "place 9" (a router without a node), "memory 3"
  std::uint64_t messages = 0;  ///< number that passed it
  std::uint64_t bytes = 0;     ///< including headers
  std::uint64_t busy_ns = 0;   ///< time held by them
  std::uint64_t wait_ns = 0;   ///< time that messages waited for it
};

/// The traffic of all links of a run.
struct LinkTraffic {
  std::uint64_t messages = 0;  ///< from a node to another
  std::uint64_t hops = 0;      ///< links passed, memory ports aside, summed over messages
  std::uint64_t passages = 0;  ///< links and memory ports passed, summed over messages
  std::uint64_t bytes = 0;     ///< messages' bytes, summed over passages
  std::uint64_t busy_ns = 0;   ///< summed over links and memory ports
  std::uint64_t wait_ns = 0;   ///< time that messages waited for links held by others, summed
};

/// A message takes one link of its route after the other, and holds them by the machine's Switching. Links are allocated in the
/// order in which messages enter the network. The host is attached to node 0 by its own link in each direction. If the machine
/// has memory ports, every node except the host, whose only link acts as one, has one in each direction: the first and the last
/// link of a route. Without contention there are no waits. Deterministic; belongs to one run.
class Links {
 public:
  /// `node_count` is without the host, at least 1.
  Links(const Machine& machine, std::uint32_t node_count);

  /// The number of links of the route, without memory ports. The host is node `node_count`.
  std::uint32_t hops(NodeId source, NodeId target) const;
  /// Sends a message of this length into the network at `now_ns`: returns when it has arrived. From its first byte to its last it
  /// takes the machine's hop_ns for each hop and its byte_ps for each byte, plus its waits. A message from a node to itself
  /// passes no link and arrives at once.
  std::uint64_t pass(NodeId source, NodeId target, std::uint64_t now_ns, std::uint64_t bytes);

  const LinkTraffic& traffic() const { return traffic_; }
  /// At most `count` of the links that carried anything: those that were held longest, in descending order, equal ones in the
  /// order of their ends.
  std::vector<LinkUse> busiest(std::size_t count) const;
  /// The number of links and memory ports that carried anything.
  std::size_t used_count() const;
  /// Expects that the links' traffic adds up to traffic().
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
  std::vector<Wire> wires_;               ///< for links that a message has passed, in the order of the first
  std::vector<std::uint32_t> table_;      ///< size a power of two: by a hash of its ends, the index of each wire, or no_wire
  std::vector<Link> links_;               ///< the current message's, including memory ports
  std::vector<std::uint32_t> route_;      ///< the wires of `links_`
  std::vector<std::uint64_t> begins_ns_;  ///< from when it has each of them
  LinkTraffic traffic_;
};

}  // namespace dmpc::nodes
