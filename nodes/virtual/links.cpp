#include "nodes/virtual/links.h"

#include <algorithm>
#include <tuple>

#include "core/base/expect.h"

namespace dmpc::nodes {

Links::Links(const Machine& machine, std::uint32_t node_count)
    : topology_(machine.topology, node_count, machine.uplinks),
      machine_(machine),
      wires_(topology_.place_count() + 1 + node_count) {}

std::uint32_t Links::hops(NodeId source, NodeId target) const {
  const NodeId host{topology_.node_count()}, door{0};
  if (source == target) {
    return 0;
  }
  const std::uint32_t to_the_host = source == host || target == host ? 1 : 0;
  return to_the_host + topology_.hops(source == host ? door : source, target == host ? door : target);
}

std::uint64_t Links::pass(NodeId source, NodeId target, std::uint64_t now_ns, std::uint64_t bytes) {
  if (source == target) {
    return now_ns;
  }
  const std::uint64_t bytes_ns = bytes * machine_.cost_of_message(bytes).byte_ps / 1000;
  find_route(source, target);
  ++traffic_.messages;
  traffic_.hops += hops(source, target);
  return pass_along_route(now_ns, bytes, bytes_ns);
}

/// Link by link: the header goes on after a hop. A circuit keeps what it has until the message has arrived, of a packet the bytes
/// pass each link behind the header. A memory port is no hop.
std::uint64_t Links::pass_along_route(std::uint64_t now_ns, std::uint64_t bytes, std::uint64_t bytes_ns) {
  std::uint64_t at_ns = now_ns;
  for (std::size_t i = 0; i < route_.size(); ++i) {
    begins_ns_[i] = start_ns(*route_[i], at_ns);
    at_ns = begins_ns_[i] + hop_ns(links_[i]);
  }
  const std::uint64_t arrives_ns = at_ns + bytes_ns;
  const bool is_circuit = machine_.switching == Switching::circuit;
  for (std::size_t i = 0; i < route_.size(); ++i) {
    hold(*route_[i], begins_ns_[i], is_circuit ? arrives_ns - begins_ns_[i] : hop_ns(links_[i]) + bytes_ns, bytes);
  }
  return arrives_ns;
}

std::uint64_t Links::hop_ns(const Link& link) const {
  const bool is_port = link.from > host_place() || link.to > host_place();
  return is_port ? 0 : machine_.hop_ns;
}

/// When the link is free for a message that is there now, which waits until then.
std::uint64_t Links::start_ns(Wire& wire, std::uint64_t now_ns) {
  if (!machine_.has_contention || wire.free_at_ns <= now_ns) {
    return now_ns;
  }
  wire.wait_ns += wire.free_at_ns - now_ns;
  traffic_.wait_ns += wire.free_at_ns - now_ns;
  return wire.free_at_ns;
}

void Links::hold(Wire& wire, std::uint64_t from_ns, std::uint64_t busy_ns, std::uint64_t bytes) {
  wire.free_at_ns = from_ns + busy_ns;
  ++wire.messages;
  wire.bytes += bytes;
  wire.busy_ns += busy_ns;
  ++traffic_.passages;
  traffic_.bytes += bytes;
  traffic_.busy_ns += busy_ns;
}

std::vector<LinkUse> Links::busiest(std::size_t count) const {
  struct Used {
    std::uint32_t from;
    const Wire* wire;
  };
  std::vector<Used> used;
  for (std::uint32_t from = 0; from < wires_.size(); ++from) {
    for (const Wire& wire : wires_[from]) {
      used.push_back({from, &wire});
    }
  }
  const auto end = used.begin() + static_cast<std::ptrdiff_t>(std::min(count, used.size()));
  std::partial_sort(used.begin(), end, used.end(), [](const Used& a, const Used& b) {
    return std::tuple(b.wire->busy_ns, a.from, a.wire->to) < std::tuple(a.wire->busy_ns, b.from, b.wire->to);
  });
  std::vector<LinkUse> uses;
  std::transform(used.begin(), end, std::back_inserter(uses), [this](const Used& one) -> LinkUse {
    const Wire& wire = *one.wire;
    return {place_name(one.from), place_name(wire.to), wire.messages, wire.bytes, wire.busy_ns, wire.wait_ns};
  });
  return uses;
}

std::size_t Links::used_count() const {
  std::size_t count = 0;
  for (const std::vector<Wire>& from_place : wires_) {
    count += from_place.size();
  }
  return count;
}

void Links::expect_sums() const {
  LinkTraffic sum;
  for (const std::vector<Wire>& from_place : wires_) {
    for (const Wire& wire : from_place) {
      sum.passages += wire.messages;
      sum.bytes += wire.bytes;
      sum.busy_ns += wire.busy_ns;
      sum.wait_ns += wire.wait_ns;
    }
  }
  core::expect(sum.passages == traffic_.passages && sum.bytes == traffic_.bytes && sum.busy_ns == traffic_.busy_ns &&
                   sum.wait_ns == traffic_.wait_ns,
               "what the links carried adds up to the whole traffic");
}

std::string Links::place_name(std::uint32_t place) const {
  const std::uint32_t node_count = topology_.node_count();
  if (place > host_place()) {
    return "memory " + std::to_string(place - host_place() - 1);
  }
  if (place == host_place()) {
    return "host";
  }
  if (place < node_count) {
    return "node " + std::to_string(place);
  }
  return topology_.kind() == TopologyKind::fat_tree ? "switch " + std::to_string(place - node_count)
                                                    : "place " + std::to_string(place);
}

/// The wire of a link, made when a message first passes it.
Links::Wire& Links::wire(const Link& link) {
  std::vector<Wire>& from_place = wires_[link.from];
  const auto at = std::lower_bound(from_place.begin(), from_place.end(), link.to,
                                   [](const Wire& wire, std::uint32_t to) { return wire.to < to; });
  return at != from_place.end() && at->to == link.to ? *at : *from_place.insert(at, Wire{.to = link.to});
}

/// A way begins at each place once, so that a wire which is made does not move another one of the route.
void Links::find_route(NodeId source, NodeId target) {
  const NodeId host{topology_.node_count()}, door{0};
  links_.clear();
  if (source == host) {
    links_.push_back({host_place(), index_of(door)});
  } else if (machine_.has_memory_port) {
    links_.push_back({memory_place(index_of(source)), index_of(source)});
  }
  topology_.append_route(source == host ? door : source, target == host ? door : target, links_);
  if (target == host) {
    links_.push_back({index_of(door), host_place()});
  } else if (machine_.has_memory_port) {
    links_.push_back({index_of(target), memory_place(index_of(target))});
  }
  route_.clear();
  for (const Link& link : links_) {
    route_.push_back(&wire(link));
  }
  begins_ns_.resize(route_.size());
}

}  // namespace dmpc::nodes
