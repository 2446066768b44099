#include "nodes/topology.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/topologies.h"

namespace dmpc::tests::topology_test {

using nodes::Link;
using nodes::NodeId;
using nodes::Topology;
using nodes::TopologyKind;

namespace {

std::vector<Link> route(const Topology& topology, std::uint32_t from, std::uint32_t to) {
  std::vector<Link> links;
  topology.append_route(NodeId{from}, NodeId{to}, links);
  return links;
}

/// The longest of all shortest ways.
std::uint32_t diameter(const Topology& topology) {
  std::uint32_t most = 0;
  for (std::uint32_t a = 0; a < topology.node_count(); ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      most = std::max(most, topology.hops(NodeId{a}, NodeId{b}));
    }
  }
  return most;
}

/// Whether the links lead from one node to the other without a gap and without a place twice.
bool is_way(const std::vector<Link>& links, std::uint32_t from, std::uint32_t to, std::uint32_t place_count) {
  std::vector<bool> visited(place_count, false);
  std::uint32_t at = from;
  for (const Link& link : links) {
    if (link.from != at || link.to >= place_count || visited[link.to]) {
      return false;
    }
    visited[at] = true;
    at = link.to;
  }
  return at == to;
}

}  // namespace

TEST_CASE("a route leads from node to node over as many links as there are hops, for every count and topology") {
  for (const TopologyKind kind : all_topologies) {
    for (const std::uint32_t count : {1U, 2U, 3U, 5U, 8U, 13U, 16U, 31U, 64U}) {
      const Topology topology(kind, count);
      bool is_right = true;
      for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = 0; b < count; ++b) {
          const auto links = route(topology, a, b);
          is_right = is_right && is_way(links, a, b, topology.place_count());
          is_right = is_right && links.size() == topology.hops(NodeId{a}, NodeId{b});
          is_right = is_right && topology.hops(NodeId{a}, NodeId{b}) == topology.hops(NodeId{b}, NodeId{a});
        }
      }
      CHECK(is_right);
    }
  }
}

TEST_CASE("a crossbar has one hop between any two nodes") {
  CHECK(route(Topology(TopologyKind::crossbar, 9), 3, 8) == std::vector<Link>{{3, 8}});
  CHECK(diameter(Topology(TopologyKind::crossbar, 64)) == 1);
}

TEST_CASE("a hypercube corrects the lowest differing bit first") {
  CHECK(route(Topology(TopologyKind::hypercube, 8), 0b001, 0b110) ==
        std::vector<Link>{{0b001, 0b000}, {0b000, 0b010}, {0b010, 0b110}});
  CHECK(diameter(Topology(TopologyKind::hypercube, 64)) == 6);
}

TEST_CASE("the smallest hypercube that holds the nodes may route through places without a node") {
  const Topology topology(TopologyKind::hypercube, 5);
  CHECK(topology.place_count() == 8);
  CHECK(route(topology, 3, 4) == std::vector<Link>{{3, 2}, {2, 0}, {0, 4}});
}

TEST_CASE("a mesh goes along x, then along y") {
  const Topology mesh(TopologyKind::mesh, 16);
  CHECK(route(mesh, 1, 11) == std::vector<Link>{{1, 2}, {2, 3}, {3, 7}, {7, 11}});
  CHECK(diameter(mesh) == 6);
}

TEST_CASE("a torus goes the shorter way around") {
  const Topology torus(TopologyKind::torus, 16);
  CHECK(route(torus, 0, 3) == std::vector<Link>{{0, 3}});
  CHECK(route(torus, 0, 2) == std::vector<Link>{{0, 1}, {1, 2}});
  CHECK(route(torus, 0, 12) == std::vector<Link>{{0, 12}});
  CHECK(diameter(torus) == 4);
}

TEST_CASE("mesh and torus are as square as the count allows") {
  CHECK(diameter(Topology(TopologyKind::mesh, 64)) == 14);
  CHECK(diameter(Topology(TopologyKind::mesh, 8)) == 4);
  CHECK(Topology(TopologyKind::mesh, 7).place_count() <= 8);
  CHECK(Topology(TopologyKind::mesh, 32).place_count() == 32);
  CHECK(diameter(Topology(TopologyKind::mesh, 31)) <= 11);
}

TEST_CASE("a fat tree goes up to the lowest common switch") {
  const Topology tree(TopologyKind::fat_tree, 16);
  CHECK(tree.place_count() == 16 + 4 + 1);
  CHECK(route(tree, 0, 3) == std::vector<Link>{{0, 16}, {16, 3}});
  CHECK(route(tree, 3, 4) == std::vector<Link>{{3, 16}, {16, 20}, {20, 17}, {17, 4}});
  CHECK(diameter(Topology(TopologyKind::fat_tree, 64)) == 6);
}

TEST_CASE("a fat tree with two uplinks has twice as many switches a level higher, and the target says which") {
  const Topology tree(TopologyKind::fat_tree, 16, 2);
  CHECK(tree.place_count() == 16 + 4 + 2);
  CHECK(route(tree, 0, 3) == std::vector<Link>{{0, 16}, {16, 3}});
  CHECK(route(tree, 3, 4) == std::vector<Link>{{3, 16}, {16, 20}, {20, 17}, {17, 4}});
  CHECK(route(tree, 3, 5) == std::vector<Link>{{3, 16}, {16, 21}, {21, 17}, {17, 5}});
}

TEST_CASE("more uplinks change no distance, and every way leads to its target") {
  for (const std::uint32_t uplinks : {1U, 2U, 3U, 4U}) {
    for (const std::uint32_t count : {1U, 5U, 16U, 61U, 64U, 257U}) {
      const Topology thin(TopologyKind::fat_tree, count), tree(TopologyKind::fat_tree, count, uplinks);
      bool is_right = true;
      for (std::uint32_t a = 0; a < count; a += 3) {
        for (std::uint32_t b = 0; b < count; ++b) {
          const auto links = route(tree, a, b);
          is_right = is_right && is_way(links, a, b, tree.place_count());
          is_right = is_right && links.size() == thin.hops(NodeId{a}, NodeId{b});
        }
      }
      CHECK(is_right);
    }
  }
  CHECK(Topology(TopologyKind::fat_tree, 64, 4).place_count() == 64 + 3 * 16);
}

TEST_CASE("uplinks are a fat tree's, and at most as many as a switch has children") {
  CHECK_THROWS_AS(Topology(TopologyKind::mesh, 16, 2), core::InternalError);
  CHECK_THROWS_AS(Topology(TopologyKind::fat_tree, 16, 0), core::InternalError);
  CHECK_THROWS_AS(Topology(TopologyKind::fat_tree, 16, 5), core::InternalError);
}

TEST_CASE("both kinds of switching have a name that is read back, and no other is") {
  for (const nodes::Switching switching : {nodes::Switching::circuit, nodes::Switching::packet}) {
    CHECK(nodes::parse_switching(nodes::name_of(switching)) == switching);
  }
  CHECK_THROWS_AS(nodes::parse_switching("wormhole"), core::InputError);
}

TEST_CASE("every topology's name is read back, and no other") {
  for (const TopologyKind kind : all_topologies) {
    CHECK(nodes::parse_topology(nodes::name_of(kind)) == kind);
  }
  CHECK_THROWS_AS(nodes::parse_topology("ring"), core::InputError);
  CHECK_THROWS_AS(nodes::parse_topology(""), core::InputError);
}

TEST_CASE("a topology without nodes, with too many, or a way to a node that is not there is refused") {
  CHECK_THROWS_AS(Topology(TopologyKind::mesh, 0), core::InternalError);
  CHECK_THROWS_AS(Topology(TopologyKind::mesh, 65537), core::InternalError);
  CHECK_THROWS_AS(Topology(TopologyKind::hypercube, 5).hops(NodeId{0}, NodeId{6}), core::InternalError);
}

}  // namespace dmpc::tests::topology_test
