#include "nodes/links.h"

#include <algorithm>

namespace dmpc::nodes {

Links::Links(const Topology& topology, bool has_contention)
    : topology_(topology), has_contention_(has_contention), wires_(topology.place_count() + 1) {}

std::uint32_t Links::hops(NodeId source, NodeId target) const {
  const NodeId host{topology_.node_count()}, door{0};
  if (source == target) {
    return 0;
  }
  const std::uint32_t to_the_host = source == host || target == host ? 1 : 0;
  return to_the_host + topology_.hops(source == host ? door : source, target == host ? door : target);
}

std::uint64_t Links::pass(NodeId source, NodeId target, std::uint64_t now_ns, std::uint64_t passage_ns) {
  if (source == target) {
    return now_ns;
  }
  find_route(source, target);
  std::uint64_t start_ns = now_ns;
  for (const Wire* wire : route_) {
    start_ns = has_contention_ ? std::max(start_ns, wire->free_at_ns) : start_ns;
  }
  for (Wire* wire : route_) {
    wire->free_at_ns = start_ns + passage_ns;
    wire->held_ns += passage_ns;
  }
  ++traffic_.messages;
  traffic_.hops += route_.size();
  traffic_.wait_ns += start_ns - now_ns;
  return start_ns + passage_ns;
}

std::uint64_t Links::busiest_ns() const {
  std::uint64_t most_ns = 0;
  for (const std::vector<Wire>& from_place : wires_) {
    for (const Wire& wire : from_place) {
      most_ns = std::max(most_ns, wire.held_ns);
    }
  }
  return most_ns;
}

/// The wire of a link, made when a message first passes it.
Links::Wire& Links::wire(const Link& link) {
  std::vector<Wire>& from_place = wires_[link.from];
  if (topology_.kind() == TopologyKind::crossbar) {  // has too many to be looked through
    from_place.resize(std::max<std::size_t>(from_place.size(), link.to + 1));
    return from_place[link.to];
  }
  for (Wire& wire : from_place) {
    if (wire.to == link.to) {
      return wire;
    }
  }
  return from_place.emplace_back(Wire{.to = link.to});
}

/// A way passes each place once, so that a wire which is made does not move another one of the route.
void Links::find_route(NodeId source, NodeId target) {
  const NodeId host{topology_.node_count()}, door{0};
  const std::uint32_t host_place = topology_.place_count();
  links_.clear();
  if (source == host) {
    links_.push_back({host_place, index_of(door)});
  }
  topology_.append_route(source == host ? door : source, target == host ? door : target, links_);
  if (target == host) {
    links_.push_back({index_of(door), host_place});
  }
  route_.clear();
  for (const Link& link : links_) {
    route_.push_back(&wire(link));
  }
}

}  // namespace dmpc::nodes
