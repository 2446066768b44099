#include "nodes/node.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

namespace dmpc::nodes::node_test {
namespace {

/// Keeps what a node sends.
struct Wire final : Network {
  struct Sent {
    NodeId target;
    PacketHeader header;
    std::vector<std::byte> payload;
  };
  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    sent.push_back({target, header, {payload.begin(), payload.end()}});
  }
  std::vector<Sent> sent;
};

/// Node 1 of three.
struct OneNode {
  static MemoryPlan plan() {
    MemoryPlan plan;
    plan[Category::queues] = LocalMemory::bytes_for<std::uint16_t>(3 * channel_count);
    return plan;
  }
  LocalMemory memory{plan()};
  Wire wire;
  Node node{NodeId{1}, 3, memory, wire};
};

constexpr NodeId target{2};

TEST_CASE("a node has no credits at first, so a send is refused and counted") {
  OneNode machine;
  CHECK(machine.node.credits(target, 0) == 0);
  CHECK_FALSE(machine.node.try_send(target, 0, 0, 42));
  CHECK(machine.wire.sent.empty());
  CHECK(machine.node.counters().refused == 1);
  CHECK(total(machine.node.counters().sent).packets == 0);
}

TEST_CASE("a send spends one credit of its target and channel") {
  OneNode machine;
  machine.node.grant(target, 1, 2);
  CHECK(machine.node.try_send(target, 1, 5, std::uint64_t{42}));
  CHECK(machine.node.credits(target, 1) == 1);
  CHECK(machine.node.try_send(target, 1, 5, std::uint64_t{43}));
  CHECK_FALSE(machine.node.try_send(target, 1, 5, std::uint64_t{44}));
  CHECK(machine.node.credits(NodeId{0}, 1) == 0);
  CHECK(machine.node.credits(target, 0) == 0);
}

/// Carries the place of what lasts.
struct PlaceWire final : Network {
  void deliver(NodeId, const PacketHeader&, std::span<const std::byte>) override { ++copies; }
  bool deliver_in_place(NodeId, const PacketHeader& header, std::span<const std::byte> front,
                        std::span<const std::byte> immutable) override {
    sent = {NodeId{header.source}, header.kind, front, immutable};
    bytes = header.bytes;
    return true;
  }
  Packet sent;
  std::uint32_t bytes = 0;
  int copies = 0;
};

TEST_CASE("a payload whose end lasts is put together, or leaves its end where it is, and counts alike") {
  const std::array<std::byte, 2> front{std::byte{1}, std::byte{2}};
  const std::array<std::byte, 3> immutable{std::byte{3}, std::byte{4}, std::byte{5}};
  std::array<std::byte, 5> room{};
  OneNode copying;
  copying.node.grant(target, 0);
  CHECK(copying.node.try_send(target, 0, 7, front, immutable, room));
  CHECK_FALSE(copying.node.try_send(target, 0, 7, front, immutable, room));
  REQUIRE(copying.wire.sent.size() == 1);
  const std::vector<std::byte> whole{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}, std::byte{5}};
  CHECK(copying.wire.sent.front().payload == whole);
  CHECK(copying.wire.sent.front().header.bytes == 5);

  LocalMemory memory(OneNode::plan());
  PlaceWire wire;
  Node referring(NodeId{1}, 3, memory, wire);
  referring.grant(target, 0);
  CHECK(referring.try_send(target, 0, 7, front, immutable, room));
  CHECK_FALSE(referring.try_send(target, 0, 7, front, immutable, room));
  CHECK(wire.copies == 0);
  CHECK(wire.sent.immutable.data() == immutable.data());
  CHECK(wire.bytes == 5);
  CHECK(total(referring.counters().sent).bytes == total(copying.node.counters().sent).bytes);
  CHECK(referring.counters().refused == 1);
  CHECK_THROWS_AS(static_cast<void>(referring.try_send(target, 0, 7, front, immutable, std::span(room).first(4))),
                  core::InternalError);
}

TEST_CASE("a packet tells what follows its front, wherever that is") {
  const std::array<std::byte, 3> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
  const Packet whole{NodeId{0}, 0, bytes};
  const Packet parted{NodeId{0}, 0, std::span(bytes).first(1), std::span(bytes).last(2)};
  for (const Packet& packet : {whole, parted}) {
    CHECK(packet.payload_bytes() == 3);
    CHECK(packet.behind(1).data() == bytes.data() + 1);
    CHECK(packet.behind(1).size() == 2);
  }
}

TEST_CASE("a packet says who sent it, what it is and how long it is") {
  OneNode machine;
  machine.node.grant(target, 0);
  REQUIRE(machine.node.try_send(target, 0, 5, std::uint64_t{42}));
  const Wire::Sent& sent = machine.wire.sent.front();
  CHECK(sent.target == target);
  CHECK(sent.header.source == 1);
  CHECK(sent.header.kind == 5);
  CHECK(sent.header.bytes == 8);
  CHECK(Packet{NodeId{1}, 5, sent.payload}.as<std::uint64_t>() == 42);
}

TEST_CASE("sent packets are counted by kind, header and payload") {
  OneNode machine;
  machine.node.grant(target, 0, 3);
  const std::array<std::byte, 100> bytes{};
  CHECK(machine.node.try_send(target, 0, 3, std::span<const std::byte>(bytes)));
  CHECK(machine.node.try_send(target, 0, 3, std::span<const std::byte>()));
  CHECK(machine.node.try_send(target, 0, 4, std::uint32_t{1}));
  CHECK(machine.node.counters().sent[3].packets == 2);
  CHECK(machine.node.counters().sent[3].bytes == 116);
  CHECK(total(machine.node.counters().sent).packets == 3);
  CHECK(total(machine.node.counters().sent).bytes == 128);
}

TEST_CASE("a view of bytes is sent as the bytes, not as the view") {
  OneNode machine;
  machine.node.grant(target, 0);
  std::array<std::byte, 5> bytes{};
  CHECK(machine.node.try_send(target, 0, 0, std::span<std::byte>(bytes)));
  CHECK(machine.wire.sent.front().payload.size() == 5);
}

TEST_CASE("a reserved send without a credit is a broken invariant") {
  OneNode machine;
  CHECK_THROWS_AS(machine.node.send_reserved(target, 0, 0, 1), core::InternalError);
}

TEST_CASE("targets, channels and kinds that do not exist are refused loudly") {
  OneNode machine;
  machine.node.grant(target, 0);
  CHECK_THROWS_AS(machine.node.grant(NodeId{3}, 0), core::InternalError);
  CHECK_THROWS_AS(machine.node.grant(target, channel_count), core::InternalError);
  CHECK_THROWS_AS(static_cast<void>(machine.node.try_send(target, 0, packet_kind_count, 1)), core::InternalError);
}

TEST_CASE("credits reach their limit and no further") {
  OneNode machine;
  machine.node.grant(target, 0, credits_max);
  CHECK(machine.node.credits(target, 0) == credits_max);
  CHECK_THROWS_AS(machine.node.grant(target, 0), core::InternalError);
}

TEST_CASE("a payload of another size than its kind's is a broken invariant") {
  const std::array<std::byte, 3> bytes{};
  CHECK_THROWS_AS(static_cast<void>((Packet{NodeId{0}, 0, bytes}.as<std::uint32_t>())), core::InternalError);
}

}  // namespace
}  // namespace dmpc::nodes::node_test
