#include "nodes/topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::nodes {

namespace {

constexpr std::array<std::pair<std::string_view, TopologyKind>, 5> names{{{"crossbar", TopologyKind::crossbar},
                                                                          {"hypercube", TopologyKind::hypercube},
                                                                          {"mesh", TopologyKind::mesh},
                                                                          {"torus", TopologyKind::torus},
                                                                          {"fat-tree", TopologyKind::fat_tree}}};
constexpr std::uint32_t switch_children = 4;
constexpr std::uint32_t place_count_max = 65536;

/// The largest divisor of `count` from half its square root to its square root; the root rounded down if there is none.
std::uint32_t rows_of(std::uint32_t count) {
  std::uint32_t root = 1;
  while ((root + 1) * (root + 1) <= count) {
    ++root;
  }
  for (std::uint32_t rows = root; 2 * rows >= root; --rows) {
    if (count % rows == 0) {
      return rows;
    }
  }
  return root;
}

}  // namespace

std::string_view name_of(TopologyKind kind) { return names[static_cast<std::size_t>(kind)].first; }

TopologyKind parse_topology(std::string_view name) {
  std::string known;
  for (const auto& [text, kind] : names) {
    if (text == name) {
      return kind;
    }
    known += known.empty() ? "" : ", ";
    known += text;
  }
  throw core::InputError("there is no topology \"" + std::string(name) + "\": use one of " + known);
}

std::string_view name_of(Switching switching) { return switching == Switching::circuit ? "circuit" : "packet"; }

Switching parse_switching(std::string_view name) {
  for (const Switching switching : {Switching::circuit, Switching::packet}) {
    if (name == name_of(switching)) {
      return switching;
    }
  }
  throw core::InputError("there is no switching \"" + std::string(name) + "\": use circuit or packet");
}

Topology::Topology(TopologyKind kind, std::uint32_t node_count, std::uint32_t uplinks)
    : kind_(kind), node_count_(node_count), place_count_(node_count) {
  core::expect(node_count >= 1 && node_count <= place_count_max, "a topology has from 1 to 65536 nodes");
  core::expect(uplinks >= 1 && uplinks <= (kind == TopologyKind::fat_tree ? uplinks_max : 1), "fat trees alone have uplinks");
  if (kind == TopologyKind::hypercube) {
    place_count_ = std::bit_ceil(node_count);
  } else if (kind == TopologyKind::mesh || kind == TopologyKind::torus) {
    height_ = rows_of(node_count);
    width_ = core::ceil_divide(node_count, height_);
    place_count_ = width_ * height_;
  } else if (kind == TopologyKind::fat_tree) {
    level_first_ = {0};
    level_copies_ = {1};
    for (std::uint32_t count = node_count, copies = 1; count > 1; copies *= uplinks) {
      count = core::ceil_divide(count, switch_children);
      level_first_.push_back(place_count_);
      level_copies_.push_back(copies);
      place_count_ += count * copies;
    }
  }
}

std::uint32_t Topology::hops(NodeId source, NodeId target) const {
  const std::uint32_t a = index_of(source), b = index_of(target);
  core::expect(a < node_count_ && b < node_count_, "a way leads from node to node");
  switch (kind_) {
    case TopologyKind::crossbar:
      return a == b ? 0 : 1;
    case TopologyKind::hypercube:
      return static_cast<std::uint32_t>(std::popcount(a ^ b));
    case TopologyKind::mesh:
    case TopologyKind::torus:
      return ring_hops(a % width_, b % width_, width_) + ring_hops(a / width_, b / width_, height_);
    case TopologyKind::fat_tree:
      return 2 * levels_to_common_switch(a, b);
  }
  return 0;
}

void Topology::append_route(NodeId source, NodeId target, std::vector<Link>& links) const {
  const std::uint32_t a = index_of(source), b = index_of(target);
  core::expect(a < node_count_ && b < node_count_, "a way leads from node to node");
  if (kind_ == TopologyKind::fat_tree) {
    return append_tree_route(a, b, links);
  }
  for (std::uint32_t at = a; at != b;) {
    const std::uint32_t next = next_place(at, b);
    links.push_back({at, next});
    at = next;
  }
}

/// Along one side of a mesh, or around one ring of a torus.
std::uint32_t Topology::ring_hops(std::uint32_t from, std::uint32_t to, std::uint32_t size) const {
  const std::uint32_t straight = from < to ? to - from : from - to;
  return kind_ == TopologyKind::torus ? std::min(straight, size - straight) : straight;
}

/// The neighbour on the shorter way to a different place.
std::uint32_t Topology::ring_step(std::uint32_t from, std::uint32_t to, std::uint32_t size) const {
  const std::uint32_t upwards = (to + size - from) % size;
  const bool goes_up = kind_ == TopologyKind::torus ? 2 * upwards <= size : to > from;
  return (from + (goes_up ? 1 : size - 1)) % size;
}

std::uint32_t Topology::next_place(std::uint32_t at, std::uint32_t target) const {
  if (kind_ == TopologyKind::crossbar) {
    return target;
  }
  if (kind_ == TopologyKind::hypercube) {
    const std::uint32_t different = at ^ target;
    return at ^ (different & (~different + 1));
  }
  const std::uint32_t x = at % width_, y = at / width_;
  if (x != target % width_) {
    return y * width_ + ring_step(x, target % width_, width_);
  }
  return ring_step(y, target / width_, height_) * width_ + x;
}

std::uint32_t Topology::levels_to_common_switch(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t levels = 0;
  for (; a != b; ++levels) {
    a /= switch_children;
    b /= switch_children;
  }
  return levels;
}

/// The place of the switch that many levels above a node, on a way to the target.
std::uint32_t Topology::switch_above(std::uint32_t leaf, std::uint32_t level, std::uint32_t target) const {
  std::uint32_t index = leaf;
  for (std::uint32_t i = 0; i < level; ++i) {
    index /= switch_children;
  }
  return level_first_[level] + index * level_copies_[level] + target % level_copies_[level];
}

void Topology::append_tree_route(std::uint32_t source, std::uint32_t target, std::vector<Link>& links) const {
  const std::uint32_t top = levels_to_common_switch(source, target);
  for (std::uint32_t level = 0; level < top; ++level) {
    links.push_back({switch_above(source, level, target), switch_above(source, level + 1, target)});
  }
  for (std::uint32_t level = top; level > 0; --level) {
    links.push_back({switch_above(target, level, target), switch_above(target, level - 1, target)});
  }
}

}  // namespace dmpc::nodes
