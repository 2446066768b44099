// The topology of a machine's network, and the links that a packet passes.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "nodes/node_id.h"

namespace dmpc::nodes {

/// crossbar: every two nodes share a link. hypercube: neighbours differ in one bit. mesh, torus: two dimensions, as near to
/// square as the count allows, the torus closed to rings. fat_tree: nodes are the leaves of a tree of switches with 4 children
/// each; if a switch has several uplinks, each leads to a different switch, so that the number of paths grows with the levels.
enum class TopologyKind : std::uint8_t { crossbar, hypercube, mesh, torus, fat_tree };

/// "crossbar", "hypercube", "mesh", "torus" or "fat-tree".
std::string_view name_of(TopologyKind kind);
/// Parses a name; throws core::InputError, listing the names, for anything else.
TopologyKind parse_topology(std::string_view name);

/// The links that a message holds. circuit: each link of its route, from when its header has it until the whole message has
/// arrived, so that a waiting header holds the links behind it (S. Nugent, "The iPSC/2 Direct-Connect Communications Technology",
/// 1988). packet: each link for as long as its own bytes pass it, so that a message that waits for one link leaves the others
/// free; the header does not wait for the tail (P. Kermani, L. Kleinrock, "Virtual Cut-Through: A New Computer Communication
/// Switching Technique", 1979), and routers have buffers for what waits.
enum class Switching : std::uint8_t { circuit, packet };

/// "circuit" or "packet".
std::string_view name_of(Switching switching);
/// Parses a name; throws core::InputError, listing the names, for anything else.
Switching parse_switching(std::string_view name);

/// One directed link between neighbouring places. Places below node_count() are nodes; the others are switches, or the unused
/// corners of a machine with more places than nodes, which only route.
struct Link {
  std::uint32_t from = 0, to = 0;
  constexpr bool operator==(const Link&) const = default;
};

/// An immutable value. Routes are deterministic, depend on source and target alone, and are shortest.
class Topology {
 public:
  /// Any node_count from 1 to 65,536: a hypercube is the smallest that holds them; mesh and torus have width >= height, height
  /// being the largest divisor of the count that is at least half its root, or else the root rounded down, so that fewer than
  /// `height` places stay unused. `uplinks`, 1 to uplinks_max, are those of a fat tree's switch: the nodes below a switch of
  /// level l have uplinks^(l-1) switches of that level above them (S. R. Oehring and others, "On Generalized Fat Trees", 1995:
  /// XGFT(h; 4, ..., 4; 1, uplinks, ..., uplinks)). Other kinds have 1.
  Topology(TopologyKind kind, std::uint32_t node_count, std::uint32_t uplinks = 1);

  /// A switch with as many uplinks as children has the same bandwidth upwards as from below.
  static constexpr std::uint32_t uplinks_max = 4;

  TopologyKind kind() const { return kind_; }
  std::uint32_t node_count() const { return node_count_; }
  /// For a mesh or torus, whose places are numbered row by row; otherwise 1.
  std::uint32_t columns() const { return width_; }
  /// Nodes, unused places and switches: the places that a Link can name are below this.
  std::uint32_t place_count() const { return place_count_; }

  /// The number of links of the route; 0 from a node to itself.
  std::uint32_t hops(NodeId source, NodeId target) const;
  /// Appends these links, in order. Hypercube: e-cube, the lowest differing address bit first (H. Sullivan, T. R. Bashkow, 1977).
  /// Mesh and torus: along x, then along y, on a ring the shorter way, upwards if both are equal. Fat tree: up to the lowest
  /// common switch and down; of several uplinks the one given by the target's number, so that routes to different targets stay
  /// apart (E. Zahavi, "D-Mod-K Routing Providing Non-Blocking Traffic for Shift Permutations on Real Life Fat Trees", 2010).
  void append_route(NodeId source, NodeId target, std::vector<Link>& links) const;

 private:
  std::uint32_t ring_hops(std::uint32_t from, std::uint32_t to, std::uint32_t size) const;
  std::uint32_t ring_step(std::uint32_t from, std::uint32_t to, std::uint32_t size) const;
  std::uint32_t levels_to_common_switch(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t switch_above(std::uint32_t leaf, std::uint32_t level, std::uint32_t target) const;
  std::uint32_t next_place(std::uint32_t at, std::uint32_t target) const;
  void append_tree_route(std::uint32_t source, std::uint32_t target, std::vector<Link>& links) const;

  TopologyKind kind_;
  std::uint32_t node_count_;
  std::uint32_t place_count_;
  std::uint32_t width_ = 1, height_ = 1;       ///< for mesh and torus
  std::vector<std::uint32_t> level_first_{};   ///< fat tree: the first place of each level; level 0 are the nodes
  std::vector<std::uint32_t> level_copies_{};  ///< fat tree: switches with the same nodes below, by level
};

}  // namespace dmpc::nodes
