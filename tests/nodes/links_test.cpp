#include "nodes/links.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

namespace dmpc::tests {
namespace {

using nodes::Links;
using nodes::NodeId;
using nodes::Topology;
using nodes::TopologyKind;

constexpr NodeId node(std::uint32_t index) { return NodeId{index}; }

Links links_of(TopologyKind kind, std::uint32_t node_count, bool has_contention = true) {
  return Links(Topology(kind, node_count), has_contention);
}

}  // namespace

TEST_CASE("hops are the topology's, and the host hangs on node 0") {
  for (const TopologyKind kind :
       {TopologyKind::crossbar, TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree}) {
    for (const std::uint32_t count : {1U, 2U, 7U, 16U}) {
      const Topology topology(kind, count);
      const Links links(topology, true);
      bool is_right = links.hops(node(count), node(count)) == 0;
      for (std::uint32_t a = 0; a < count; ++a) {
        is_right = is_right && links.hops(node(a), node(count)) == topology.hops(node(a), node(0)) + 1;
        is_right = is_right && links.hops(node(count), node(a)) == topology.hops(node(0), node(a)) + 1;
        for (std::uint32_t b = 0; b < count; ++b) {
          is_right = is_right && links.hops(node(a), node(b)) == topology.hops(node(a), node(b));
        }
      }
      CHECK(is_right);
    }
  }
}

TEST_CASE("a message passes as many links as there are hops") {
  for (const TopologyKind kind :
       {TopologyKind::crossbar, TopologyKind::hypercube, TopologyKind::mesh, TopologyKind::torus, TopologyKind::fat_tree}) {
    Links links = links_of(kind, 13);
    std::uint64_t hops = 0;
    for (std::uint32_t a = 0; a <= 13; ++a) {
      for (std::uint32_t b = 0; b <= 13; ++b) {
        links.pass(node(a), node(b), 0, 1);
        hops += links.hops(node(a), node(b));
      }
    }
    CHECK(links.traffic().hops == hops);
    CHECK(links.traffic().messages == 13 * 14);
  }
}

TEST_CASE("a message arrives after its passage, and at once where it stands") {
  Links links = links_of(TopologyKind::hypercube, 8);
  CHECK(links.pass(node(0), node(7), 100, 30) == 130);
  CHECK(links.pass(node(5), node(5), 100, 30) == 100);
  CHECK(links.traffic().messages == 1);
  CHECK(links.traffic().wait_ns == 0);
}

TEST_CASE("a link carries one message at a time, in the order of their coming") {
  Links links = links_of(TopologyKind::crossbar, 4);
  CHECK(links.pass(node(1), node(2), 0, 10) == 10);
  CHECK(links.pass(node(1), node(2), 4, 10) == 20);
  CHECK(links.pass(node(1), node(2), 25, 10) == 35);
  CHECK(links.traffic().wait_ns == 6);
}

TEST_CASE("other links and the same link's other direction are free") {
  Links links = links_of(TopologyKind::mesh, 4);
  CHECK(links.pass(node(0), node(1), 0, 10) == 10);
  CHECK(links.pass(node(1), node(0), 0, 10) == 10);
  CHECK(links.pass(node(2), node(3), 0, 10) == 10);
  CHECK(links.pass(node(0), node(2), 0, 10) == 10);
  CHECK(links.traffic().wait_ns == 0);
}

TEST_CASE("a message waits for the last of its links and holds all of them from then on") {
  Links links = links_of(TopologyKind::hypercube, 8);
  CHECK(links.pass(node(1), node(3), 0, 100) == 100);  // holds 1-3
  CHECK(links.pass(node(3), node(7), 0, 40) == 40);    // holds 3-7
  CHECK(links.pass(node(0), node(7), 0, 10) == 110);   // 0-1, 1-3, 3-7
  CHECK(links.pass(node(0), node(1), 0, 5) == 115);
  CHECK(links.pass(node(3), node(7), 50, 5) == 115);
}

TEST_CASE("without contention every link is free for everybody") {
  Links links = links_of(TopologyKind::crossbar, 4, false);
  for (int i = 0; i < 5; ++i) {
    CHECK(links.pass(node(1), node(2), 0, 10) == 10);
  }
  CHECK(links.traffic().wait_ns == 0);
  CHECK(links.busiest_ns() == 50);
}

TEST_CASE("a saturated link carries one message after the other without a gap") {
  Links links = links_of(TopologyKind::hypercube, 16);
  constexpr std::uint32_t passage_ns = 10, count = 1000;
  std::uint64_t last_ns = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    last_ns = links.pass(node(2 * (i % 8) + 1), node(16), 9 * i, passage_ns);  // all by way of 0; offered more than it carries
  }
  CHECK(last_ns == count * passage_ns);
  CHECK(links.busiest_ns() == last_ns);
  CHECK(links.traffic().wait_ns == count * (count - 1) / 2);
}

TEST_CASE("the busiest link is the one that was held longest") {
  Links links = links_of(TopologyKind::mesh, 9);
  CHECK(links.busiest_ns() == 0);
  links.pass(node(0), node(2), 0, 7);  // 0-1, 1-2
  links.pass(node(1), node(2), 0, 5);
  links.pass(node(6), node(8), 0, 11);
  CHECK(links.busiest_ns() == 12);
}

TEST_CASE("the host's link to the nodes and the one back are two") {
  Links links = links_of(TopologyKind::crossbar, 2);
  CHECK(links.pass(node(2), node(0), 0, 10) == 10);
  CHECK(links.pass(node(0), node(2), 0, 10) == 10);
  CHECK(links.pass(node(1), node(2), 0, 10) == 20);
  CHECK(links.pass(node(2), node(1), 0, 10) == 20);
}

}  // namespace dmpc::tests
