#include "nodes/virtual/links.h"

#include <algorithm>
#include <tuple>

#include "core/base/expect.h"

namespace dmpc::nodes {
namespace {

constexpr std::uint32_t no_wire = 0xffffffffU;
constexpr std::size_t table_size_at_first = 64;

}  // namespace

Links::Links(const Machine& machine, std::uint32_t node_count)
    : topology_(machine.topology, node_count, machine.uplinks), machine_(machine), table_(table_size_at_first, no_wire) {}

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

/// Link by link: the header advances after each hop. A circuit holds its links until the message has arrived; a packet's bytes
/// pass each link behind the header. A memory port is no hop.
std::uint64_t Links::pass_along_route(std::uint64_t now_ns, std::uint64_t bytes, std::uint64_t bytes_ns) {
  std::uint64_t at_ns = now_ns;
  for (std::size_t i = 0; i < route_.size(); ++i) {
    begins_ns_[i] = start_ns(wires_[route_[i]], at_ns);
    at_ns = begins_ns_[i] + hop_ns(links_[i]);
  }
  const std::uint64_t arrives_ns = at_ns + bytes_ns;
  const bool is_circuit = machine_.switching == Switching::circuit;
  for (std::size_t i = 0; i < route_.size(); ++i) {
    hold(wires_[route_[i]], begins_ns_[i], is_circuit ? arrives_ns - begins_ns_[i] : hop_ns(links_[i]) + bytes_ns, bytes);
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
  std::vector<const Wire*> used;
  std::transform(wires_.begin(), wires_.end(), std::back_inserter(used), [](const Wire& wire) { return &wire; });
  const auto end = used.begin() + static_cast<std::ptrdiff_t>(std::min(count, used.size()));
  std::partial_sort(used.begin(), end, used.end(), [](const Wire* a, const Wire* b) {
    return std::tuple(b->busy_ns, a->link.from, a->link.to) < std::tuple(a->busy_ns, b->link.from, b->link.to);
  });
  std::vector<LinkUse> uses;
  std::transform(used.begin(), end, std::back_inserter(uses), [this](const Wire* wire) -> LinkUse {
    return {place_name(wire->link.from), place_name(wire->link.to), wire->messages, wire->bytes, wire->busy_ns, wire->wait_ns};
  });
  return uses;
}

std::size_t Links::used_count() const { return wires_.size(); }

void Links::expect_sums() const {
  LinkTraffic sum;
  for (const Wire& wire : wires_) {
    sum.passages += wire.messages;
    sum.bytes += wire.bytes;
    sum.busy_ns += wire.busy_ns;
    sum.wait_ns += wire.wait_ns;
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

/// The wire of a link, created when a message first passes it.
std::uint32_t Links::wire_of(const Link& link) {
  std::uint32_t& wire = table_[place_in_table(link)];
  if (wire != no_wire) [[likely]] {
    return wire;
  }
  wire = static_cast<std::uint32_t>(wires_.size());
  wires_.push_back({.link = link});
  if (2 * wires_.size() > table_.size()) {
    grow_table();
  }
  return static_cast<std::uint32_t>(wires_.size() - 1);
}

/// The slot of the link's wire, or where it would be: the table is at most half full.
std::size_t Links::place_in_table(const Link& link) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = (link.from * 0x9e3779b97f4a7c15U + link.to * 0xc2b2ae3d27d4eb4fU) >> 32U & mask;
  while (table_[at] != no_wire && !(wires_[table_[at]].link == link)) {
    at = (at + 1) & mask;
  }
  return at;
}

void Links::grow_table() {
  table_.assign(2 * table_.size(), no_wire);
  for (std::uint32_t wire = 0; wire < wires_.size(); ++wire) {
    table_[place_in_table(wires_[wire].link)] = wire;
  }
}

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
    route_.push_back(wire_of(link));
  }
  begins_ns_.resize(route_.size());
}

}  // namespace dmpc::nodes
