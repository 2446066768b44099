#include "nodes/virtual/links.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/support/topologies.h"

namespace dmpc::tests::virtual_links_test {
namespace {

using nodes::Links;
using nodes::LinkUse;
using nodes::Machine;
using nodes::NodeId;
using nodes::Topology;
using nodes::TopologyKind;

constexpr NodeId node(std::uint32_t index) { return NodeId{index}; }

/// A byte takes a nanosecond and a hop nothing, so that a message takes as many nanoseconds as it has bytes.
Machine wired_as(TopologyKind kind) {
  Machine machine{.topology = kind};
  machine.short_message.byte_ps = machine.long_message.byte_ps = 1000;
  return machine;
}

Links links_of(TopologyKind kind, std::uint32_t node_count) { return Links(wired_as(kind), node_count); }

/// Links without contention.
Links free_links_of(TopologyKind kind, std::uint32_t node_count) {
  Machine machine = wired_as(kind);
  machine.has_contention = false;
  return Links(machine, node_count);
}

/// Links with a memory port for each node.
Links ported_links_of(TopologyKind kind, std::uint32_t node_count) {
  Machine machine = wired_as(kind);
  machine.has_memory_port = true;
  return Links(machine, node_count);
}

/// Links with packet switching, each hop of which takes 3 ns.
Links packet_links_of(TopologyKind kind, std::uint32_t node_count, bool has_memory_port = false) {
  Machine machine = wired_as(kind);
  machine.switching = nodes::Switching::packet;
  machine.hop_ns = 3;
  machine.has_memory_port = has_memory_port;
  return Links(machine, node_count);
}

/// The time that the busiest link was held.
std::uint64_t busiest_ns(const Links& links) {
  const std::vector<LinkUse> busiest = links.busiest(1);
  return busiest.empty() ? 0 : busiest.front().busy_ns;
}

/// How many links carry something once every node has sent a message to every other one.
std::size_t wires_of(TopologyKind kind, std::uint32_t node_count) {
  Links links = links_of(kind, node_count);
  for (std::uint32_t a = 0; a < node_count; ++a) {
    for (std::uint32_t b = 0; b < node_count; ++b) {
      links.pass(node(a), node(b), 0, 1);
    }
  }
  return links.used_count();
}

/// "node 0 - node 1: 2 messages, 30 bytes, busy 30, wait 5".
std::string text_of(const LinkUse& use) {
  return use.from + " - " + use.to + ": " + std::to_string(use.messages) + " messages, " + std::to_string(use.bytes) +
         " bytes, busy " + std::to_string(use.busy_ns) + ", wait " + std::to_string(use.wait_ns);
}

std::vector<std::string> texts_of(const Links& links) {
  std::vector<std::string> texts;
  for (const LinkUse& use : links.busiest(100)) {
    texts.push_back(text_of(use));
  }
  return texts;
}

}  // namespace

TEST_CASE("hops are the topology's, and the host hangs on node 0") {
  for (const TopologyKind kind : all_topologies) {
    for (const std::uint32_t count : {1U, 2U, 7U, 16U}) {
      const Topology topology(kind, count);
      const Links links = links_of(kind, count);
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
  for (const TopologyKind kind : all_topologies) {
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

TEST_CASE("a circuit takes one link after the other and keeps what it has until its message has arrived") {
  Links links = links_of(TopologyKind::hypercube, 8);
  CHECK(links.pass(node(1), node(3), 0, 100) == 100);  // holds 1-3
  CHECK(links.pass(node(3), node(7), 0, 40) == 40);    // holds 3-7
  CHECK(links.pass(node(0), node(7), 0, 10) == 110);   // 0-1, 1-3, 3-7
  CHECK(links.pass(node(0), node(1), 0, 5) == 115);
  CHECK(links.pass(node(3), node(7), 50, 5) == 115);
}

TEST_CASE("without contention every link is free for everybody") {
  Links links = free_links_of(TopologyKind::crossbar, 4);
  for (int i = 0; i < 5; ++i) {
    CHECK(links.pass(node(1), node(2), 0, 10) == 10);
  }
  CHECK(links.traffic().wait_ns == 0);
  CHECK(busiest_ns(links) == 50);
}

TEST_CASE("the host's link to the nodes and the one back are two") {
  Links links = links_of(TopologyKind::crossbar, 2);
  CHECK(links.pass(node(2), node(0), 0, 10) == 10);
  CHECK(links.pass(node(0), node(2), 0, 10) == 10);
  CHECK(links.pass(node(1), node(2), 0, 10) == 20);
  CHECK(links.pass(node(2), node(1), 0, 10) == 20);
}

TEST_CASE("a message takes its hops and its bytes, by the rate of its class, rounded once") {
  Machine machine{.topology = TopologyKind::hypercube, .short_bytes_max = 100, .hop_ns = 1000};
  machine.short_message.byte_ps = 1500;
  machine.long_message.byte_ps = 300;
  Links links(machine, 8);
  CHECK(links.pass(node(0), node(7), 0, 1) == 3 * 1000 + 1);
  CHECK(links.pass(node(1), node(0), 0, 100) == 1000 + 150);
  CHECK(links.pass(node(2), node(6), 0, 101) == 1000 + 30);
}

TEST_CASE("each topology has as many links as its drawing") {
  CHECK(wires_of(TopologyKind::crossbar, 12) == 12 * 11);
  CHECK(wires_of(TopologyKind::hypercube, 16) == 16 * 4);
  CHECK(wires_of(TopologyKind::mesh, 12) == 2 * (3 * 3 + 4 * 2));   // 3 rows of 3, 4 columns of 2, both ways
  CHECK(wires_of(TopologyKind::torus, 16) == 2 * (4 * 4 + 4 * 4));  // 4 rows of 4, 4 columns of 4
  CHECK(wires_of(TopologyKind::torus, 4) == 2 * (2 + 2));           // rings of two have one link each way, not two
  CHECK(wires_of(TopologyKind::fat_tree, 16) == 2 * (16 + 4));      // 16 leaves, 4 switches below the root
  CHECK(wires_of(TopologyKind::fat_tree, 4) == 2 * 4);
  for (const TopologyKind kind : all_topologies) {
    CHECK(wires_of(kind, 1) == 0);
    CHECK(wires_of(kind, 2) == (kind == TopologyKind::fat_tree ? 4 : 2));
  }
}

TEST_CASE("each link knows what it carried, and a circuit that waits holds those that it has") {
  Links links = links_of(TopologyKind::hypercube, 8);
  links.pass(node(1), node(3), 0, 100);
  links.pass(node(3), node(7), 0, 40);
  links.pass(node(0), node(7), 10, 20);  // over 0-1 from 10 on, over 1-3 and 3-7 from 100 on
  CHECK(texts_of(links) == std::vector<std::string>{"node 1 - node 3: 2 messages, 120 bytes, busy 120, wait 90",
                                                    "node 0 - node 1: 1 messages, 20 bytes, busy 110, wait 0",
                                                    "node 3 - node 7: 2 messages, 60 bytes, busy 60, wait 0"});
  CHECK(links.traffic().hops == 5);
  CHECK(links.traffic().passages == 5);
  CHECK(links.traffic().bytes == 200);
  CHECK(links.traffic().busy_ns == 290);
  CHECK(links.traffic().wait_ns == 90);
}

TEST_CASE("of links that are free at the same time the first on the way is waited for") {
  Links links = links_of(TopologyKind::mesh, 9);
  links.pass(node(0), node(2), 0, 50);
  links.pass(node(0), node(2), 20, 50);
  CHECK(texts_of(links) == std::vector<std::string>{"node 0 - node 1: 2 messages, 100 bytes, busy 100, wait 30",
                                                    "node 1 - node 2: 2 messages, 100 bytes, busy 100, wait 0"});
}

TEST_CASE("the busiest links come first, and no more than asked for") {
  Links links = links_of(TopologyKind::crossbar, 4);
  CHECK(links.busiest(5).empty());
  CHECK(links.used_count() == 0);
  links.pass(node(2), node(3), 0, 7);
  links.pass(node(4), node(0), 0, 9);
  links.pass(node(0), node(1), 0, 7);
  CHECK(links.busiest(0).empty());
  CHECK(links.busiest(2).size() == 2);
  CHECK(texts_of(links) == std::vector<std::string>{"host - node 0: 1 messages, 9 bytes, busy 9, wait 0",
                                                    "node 0 - node 1: 1 messages, 7 bytes, busy 7, wait 0",
                                                    "node 2 - node 3: 1 messages, 7 bytes, busy 7, wait 0"});
  CHECK(links.used_count() == 3);
}

TEST_CASE("switches and places without a node have names of their own") {
  Links tree = links_of(TopologyKind::fat_tree, 5), cube = links_of(TopologyKind::hypercube, 7);
  tree.pass(node(4), node(0), 0, 1);
  CHECK(texts_of(tree).back() == "switch 2 - switch 0: 1 messages, 1 bytes, busy 1, wait 0");
  cube.pass(node(6), node(3), 0, 1);  // 110, 111, 011
  CHECK(texts_of(cube).back() == "place 7 - node 3: 1 messages, 1 bytes, busy 1, wait 0");
}

TEST_CASE("what every link carried adds up to the traffic, with and without memory ports") {
  std::mt19937 random(3);
  const auto draw = [&random](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
  for (const TopologyKind kind : all_topologies) {
    Links plain = links_of(kind, 13), ported = ported_links_of(kind, 13), free = free_links_of(kind, 13);
    for (std::uint64_t now_ns = 0; now_ns < 2000; now_ns += 2) {
      const std::uint32_t source = draw(14), target = draw(14), bytes = draw(40);
      for (Links* const links : {&plain, &ported, &free}) {
        links->pass(node(source), node(target), now_ns, bytes);
      }
    }
    for (const Links* const links : {&plain, &ported, &free}) {
      CHECK_NOTHROW(links->expect_sums());
    }
    CHECK(plain.traffic().wait_ns > 0);
    CHECK(free.traffic().wait_ns == 0);
    CHECK(plain.traffic().hops == ported.traffic().hops);
    CHECK(plain.traffic().passages == plain.traffic().hops);
  }
}

TEST_CASE("a memory port lets one message out at a time, over whatever links they go") {
  Links plain = links_of(TopologyKind::hypercube, 8), ported = ported_links_of(TopologyKind::hypercube, 8);
  for (const std::uint32_t neighbour : {1U, 2U, 4U}) {
    CHECK(plain.pass(node(0), node(neighbour), 0, 10) == 10);
  }
  CHECK(ported.pass(node(0), node(1), 0, 10) == 10);
  CHECK(ported.pass(node(0), node(2), 0, 10) == 20);
  CHECK(ported.pass(node(0), node(4), 5, 10) == 30);
  CHECK(texts_of(ported).front() == "memory 0 - node 0: 3 messages, 30 bytes, busy 30, wait 25");
}

TEST_CASE("a memory port lets one message in at a time, from wherever they come") {
  Links plain = links_of(TopologyKind::crossbar, 9), ported = ported_links_of(TopologyKind::crossbar, 9);
  for (std::uint64_t i = 1; i <= 8; ++i) {
    CHECK(plain.pass(node(static_cast<std::uint32_t>(i)), node(0), 0, 10) == 10);
    CHECK(ported.pass(node(static_cast<std::uint32_t>(i)), node(0), 0, 10) == 10 * i);
  }
  CHECK(ported.traffic().wait_ns == 10 * (0 + 1 + 2 + 3 + 4 + 5 + 6 + 7));
  CHECK(texts_of(ported).front() == "node 0 - memory 0: 8 messages, 80 bytes, busy 80, wait 280");
}

TEST_CASE("a node's memory port is no hop, lets a message in while another goes out, and those that pass by along") {
  Links links = ported_links_of(TopologyKind::mesh, 9);
  CHECK(links.hops(node(0), node(2)) == 2);
  CHECK(links.pass(node(1), node(4), 0, 10) == 10);
  CHECK(links.pass(node(7), node(1), 0, 10) == 10);  // into 1 by way of 4
  CHECK(links.pass(node(0), node(2), 0, 10) == 10);  // by way of 1
  CHECK(links.traffic().wait_ns == 0);
  CHECK(links.traffic().hops == 1 + 2 + 2);
  CHECK(links.traffic().passages == 5 + 2 * 3);
}

TEST_CASE("the host's link is its port: messages of the host use the ports of the nodes alone") {
  Links links = ported_links_of(TopologyKind::crossbar, 2);
  CHECK(links.pass(node(2), node(0), 0, 10) == 10);
  CHECK(links.pass(node(0), node(2), 0, 20) == 20);
  CHECK(texts_of(links) == std::vector<std::string>{"node 0 - host: 1 messages, 20 bytes, busy 20, wait 0",
                                                    "memory 0 - node 0: 1 messages, 20 bytes, busy 20, wait 0",
                                                    "node 0 - memory 0: 1 messages, 10 bytes, busy 10, wait 0",
                                                    "host - node 0: 1 messages, 10 bytes, busy 10, wait 0"});
}

TEST_CASE("a packet passes its links one after the other, its header a hop ahead of its bytes") {
  Links links = packet_links_of(TopologyKind::hypercube, 8);
  CHECK(links.pass(node(0), node(7), 100, 20) == 100 + 3 * 3 + 20);
  CHECK(texts_of(links) == std::vector<std::string>{"node 0 - node 1: 1 messages, 20 bytes, busy 23, wait 0",
                                                    "node 1 - node 3: 1 messages, 20 bytes, busy 23, wait 0",
                                                    "node 3 - node 7: 1 messages, 20 bytes, busy 23, wait 0"});
}

TEST_CASE("a packet waits for each link where it stands, and leaves those behind it to others") {
  Links links = packet_links_of(TopologyKind::hypercube, 8);
  CHECK(links.pass(node(1), node(3), 0, 100) == 103);          // holds 1-3 until then
  CHECK(links.pass(node(0), node(3), 0, 10) == 103 + 3 + 10);  // waits before 1-3, from 3 on
  CHECK(links.pass(node(0), node(1), 13, 10) == 26);           // 0-1 has been free since 13
  CHECK(links.traffic().wait_ns == 100);
  CHECK(texts_of(links).front() == "node 1 - node 3: 2 messages, 110 bytes, busy 116, wait 100");
}

TEST_CASE("where circuits hold up all that cross them, packets do not") {
  Links circuits = links_of(TopologyKind::mesh, 9), packets = packet_links_of(TopologyKind::mesh, 9);
  for (Links* const links : {&circuits, &packets}) {
    links->pass(node(2), node(5), 0, 1000);
    links->pass(node(0), node(5), 0, 10);  // 0-1, 1-2, and waits for 2-5
  }
  CHECK(circuits.pass(node(0), node(1), 20, 10) == 1000 + 10 + 10);
  CHECK(packets.pass(node(0), node(1), 20, 10) == 20 + 3 + 10);
}

TEST_CASE("packets offered beyond a link's rate leave it one after the other without a gap") {
  Links links = packet_links_of(TopologyKind::crossbar, 2);
  for (std::uint64_t i = 1; i <= 100; ++i) {
    CHECK(links.pass(node(0), node(1), 0, 10) == 13 * i);
  }
  CHECK(links.traffic().wait_ns == 13 * 99 * 100 / 2);
}

TEST_CASE("to a packet a memory port is a link without a hop") {
  Links links = packet_links_of(TopologyKind::crossbar, 3, true);
  CHECK(links.pass(node(0), node(1), 0, 10) == 13);
  CHECK(links.pass(node(0), node(2), 0, 10) == 10 + 13);
  CHECK(links.pass(node(2), node(1), 0, 10) == 3 + 10 + 10);  // into 1 behind the first
  CHECK_NOTHROW(links.expect_sums());
}

TEST_CASE("the links of packets add up, too, and without contention none is waited for") {
  std::mt19937 random(5);
  const auto draw = [&random](std::uint32_t below) { return static_cast<std::uint32_t>(random() % below); };
  for (const TopologyKind kind : all_topologies) {
    Links plain = packet_links_of(kind, 13), ported = packet_links_of(kind, 13, true);
    Machine machine = wired_as(kind);
    machine.switching = nodes::Switching::packet;
    machine.has_contention = false;
    Links free(machine, 13);
    for (std::uint64_t now_ns = 0; now_ns < 2000; now_ns += 2) {
      const std::uint32_t source = draw(14), target = draw(14), bytes = draw(40);
      CHECK(free.pass(node(source), node(target), now_ns, bytes) == now_ns + (source == target ? 0 : bytes));
      plain.pass(node(source), node(target), now_ns, bytes);
      ported.pass(node(source), node(target), now_ns, bytes);
    }
    CHECK_NOTHROW(plain.expect_sums());
    CHECK_NOTHROW(ported.expect_sums());
    CHECK(plain.traffic().wait_ns > 0);
    CHECK(free.traffic().wait_ns == 0);
  }
}

TEST_CASE("messages to different targets keep out of each other's way in a tree with as many uplinks as children") {
  Machine machine = wired_as(TopologyKind::fat_tree);
  Links thin(machine, 64);
  machine.uplinks = 4;
  Links full(machine, 64);
  std::uint64_t thin_ns = 0, full_ns = 0;
  for (std::uint32_t source = 0; source < 64; ++source) {  // every node to the one 16 further: all by way of the root
    thin_ns = std::max(thin_ns, thin.pass(node(source), node((source + 16) % 64), 0, 10));
    full_ns = std::max(full_ns, full.pass(node(source), node((source + 16) % 64), 0, 10));
  }
  CHECK(full_ns == 10);
  CHECK(thin_ns == 16 * 10);
}

TEST_CASE("without contention a memory port is never waited for") {
  Machine machine = wired_as(TopologyKind::crossbar);
  machine.has_memory_port = true;
  machine.has_contention = false;
  Links links(machine, 4);
  for (const std::uint32_t source : {1U, 2U, 3U}) {
    CHECK(links.pass(node(source), node(0), 0, 10) == 10);
  }
  CHECK(links.traffic().wait_ns == 0);
}

}  // namespace dmpc::tests::virtual_links_test
