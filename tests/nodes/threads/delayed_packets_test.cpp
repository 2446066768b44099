#include "nodes/threads/delayed_packets.h"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

namespace dmpc::nodes::delayed_packets_test {
namespace {

/// Keeps what arrives: target and number, in order.
struct Arrivals final : Network {
  struct Arrival {
    NodeId target;
    std::uint32_t number;
    std::size_t payload_bytes;
  };
  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    std::uint32_t number = 0;
    std::memcpy(&number, payload.data(), sizeof(number));
    sound = sound && header.source == 7 && header.bytes == payload.size();
    for (const std::byte byte : payload.subspan(sizeof(number))) {
      sound = sound && byte == std::byte(number % 251);
    }
    list.push_back({target, number, payload.size()});
  }
  /// The numbers that arrived at one target.
  std::vector<std::uint32_t> at(std::uint32_t target) const {
    std::vector<std::uint32_t> numbers;
    for (const Arrival& arrival : list) {
      if (arrival.target == NodeId{target}) {
        numbers.push_back(arrival.number);
      }
    }
    return numbers;
  }
  std::vector<Arrival> list;
  bool sound = true;  ///< every header and payload is as it was sent
};

constexpr Chaos always{.seed = 3, .held_percent = 100, .delay_quanta_max = 16};

/// Node 7 with room for packets held back.
struct Sender {
  explicit Sender(const Chaos& chaos, std::size_t room_bytes = DelayedPackets::room_bytes(512))
      : memory(plan(room_bytes)), held(chaos, NodeId{7}, memory, room_bytes, arrivals) {}

  static MemoryPlan plan(std::size_t room_bytes) {
    MemoryPlan plan;
    plan[Category::queues] = LocalMemory::bytes_for<std::byte>(room_bytes);
    return plan;
  }
  void send(std::uint32_t target, std::uint32_t number, std::size_t payload_bytes = sizeof(std::uint32_t)) {
    std::vector<std::byte> payload(payload_bytes, std::byte(number % 251));
    std::memcpy(payload.data(), &number, sizeof(number));
    held.deliver(NodeId{target}, {.bytes = static_cast<std::uint32_t>(payload_bytes), .source = 7}, payload);
  }
  /// Quanta until nothing is held back.
  int run_dry() {
    int quanta = 0;
    for (; !held.empty(); ++quanta) {
      held.pass_quantum();
    }
    return quanta;
  }

  LocalMemory memory;
  Arrivals arrivals;
  DelayedPackets held;
};

std::vector<std::uint32_t> numbers_to(std::uint32_t count) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = 0; number < count; ++number) {
    numbers.push_back(number);
  }
  return numbers;
}

TEST_CASE("without a draw for it no packet is held back") {
  Chaos chaos = always;
  chaos.held_percent = 0;
  Sender sender(chaos);
  for (std::uint32_t number = 0; number < 100; ++number) {
    sender.send(number % 3, number);
  }
  CHECK(sender.held.empty());
  CHECK(sender.held.count() == 0);
  CHECK(sender.arrivals.list.size() == 100);
}

TEST_CASE("a packet held back arrives after one to the most quanta, unchanged") {
  std::set<int> quanta_seen;
  Sender sender(always);
  for (std::uint32_t number = 0; number < 300; ++number) {
    sender.send(1, number, 4 + number);
    CHECK_FALSE(sender.held.empty());
    quanta_seen.insert(sender.run_dry());
  }
  CHECK(quanta_seen.size() == 16);
  CHECK(*quanta_seen.begin() == 1);
  CHECK(*quanta_seen.rbegin() == 16);
  CHECK(sender.held.count() == 300);
  CHECK(sender.arrivals.at(1) == numbers_to(300));
  CHECK(sender.arrivals.list.back().payload_bytes == 303);
  CHECK(sender.arrivals.sound);
}

TEST_CASE("the order of a pair holds, different pairs are reordered, and every packet arrives") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    CAPTURE(seed);
    Sender sender({.seed = seed, .held_percent = 60, .delay_quanta_max = 20});
    for (std::uint32_t number = 0; number < 40; ++number) {
      for (std::uint32_t target = 0; target < 4; ++target) {
        sender.send(target, number);
      }
      sender.held.pass_quantum();
    }
    sender.run_dry();
    CHECK(sender.arrivals.list.size() == 160);
    int overtakings = 0;
    for (std::size_t i = 1; i < sender.arrivals.list.size(); ++i) {
      overtakings += sender.arrivals.list[i].number < sender.arrivals.list[i - 1].number ? 1 : 0;
    }
    CHECK(overtakings > 10);
    for (std::uint32_t target = 0; target < 4; ++target) {
      CHECK(sender.arrivals.at(target) == numbers_to(40));
    }
    CHECK(sender.arrivals.sound);
  }
}

TEST_CASE("without room the oldest packets leave early, in order, and none is lost") {
  for (const std::size_t room_bytes : {std::size_t{552}, std::size_t{700}, DelayedPackets::room_bytes(512)}) {
    Sender sender({.seed = 1, .held_percent = 100, .delay_quanta_max = 1000}, room_bytes);
    for (std::uint32_t number = 0; number < 200; ++number) {
      sender.send(number % 3, number / 3, number % 2 == 0 ? 512 : 5);
    }
    CHECK_FALSE(sender.held.empty());
    CHECK(sender.arrivals.list.size() >= 170);
    sender.run_dry();
    CHECK(sender.arrivals.at(0) == numbers_to(67));
    CHECK(sender.arrivals.at(1) == numbers_to(67));
    CHECK(sender.arrivals.at(2) == numbers_to(66));
    CHECK(sender.arrivals.sound);
  }
}

TEST_CASE("packets leave on a slow link later by its factor") {
  Chaos chaos = always;
  chaos.slow_link_percent = 100;
  chaos.slow_link_factor = 5;
  Sender slow(chaos), other(always);
  slow.send(1, 0);
  other.send(1, 0);
  CHECK(slow.run_dry() == 5 * other.run_dry());
}

TEST_CASE("the room takes exactly its bytes of the local memory, and holds what is promised") {
  const std::size_t room_bytes = DelayedPackets::room_bytes(1000);
  Sender sender({.seed = 1, .held_percent = 100, .delay_quanta_max = 100}, room_bytes);
  CHECK(sender.memory.used()[Category::queues] == room_bytes);
  for (std::uint32_t number = 0; number < 4; ++number) {
    sender.send(1, number, 1000);
  }
  for (std::uint32_t number = 0; number < 16; ++number) {
    sender.send(2, number, small_payload_bytes);
  }
  CHECK(sender.arrivals.list.empty());
}

TEST_CASE("a packet without a payload is held back like any other") {
  struct Count final : Network {
    void deliver(NodeId /*target*/, const PacketHeader& /*header*/, std::span<const std::byte> payload) override {
      empty += payload.empty() ? 1 : 0;
    }
    int empty = 0;
  } count;
  LocalMemory memory(Sender::plan(1000));
  DelayedPackets held(always, NodeId{7}, memory, 1000, count);
  held.deliver(NodeId{1}, {}, {});
  CHECK(count.empty == 0);
  for (int quantum = 0; quantum < 16; ++quantum) {
    held.pass_quantum();
  }
  CHECK(count.empty == 1);
}

TEST_CASE("a packet larger than the room and a header that lies are broken invariants") {
  Sender sender(always, 128);
  CHECK_THROWS_AS(sender.send(1, 0, 200), core::InternalError);
  const std::array<std::byte, 3> payload{};
  CHECK_THROWS_AS(sender.held.deliver(NodeId{1}, {.bytes = 4}, payload), core::InternalError);
}

}  // namespace
}  // namespace dmpc::nodes::delayed_packets_test
