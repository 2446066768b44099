#include "nodes/mailbox.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace dmpc::nodes::mailbox_test {
namespace {

struct OneMailbox {
  explicit OneMailbox(const MailboxCapacity& capacity) : memory(plan_for(capacity)), mailbox(capacity, memory) {}

  static MemoryPlan plan_for(const MailboxCapacity& capacity) {
    MemoryPlan plan;
    plan[Category::mailbox] = capacity.bytes();
    return plan;
  }
  bool push(std::uint16_t source, const std::vector<std::byte>& payload, PacketKind kind = 0) {
    return mailbox.push({.bytes = static_cast<std::uint32_t>(payload.size()), .source = source, .kind = kind}, payload, awake);
  }
  bool push_number(std::uint16_t source, std::uint8_t number) { return push(source, {std::byte{number}}); }
  /// (source, first byte) of all packets that are taken now.
  std::vector<std::pair<std::uint32_t, int>> take() {
    std::vector<std::pair<std::uint32_t, int>> taken;
    mailbox.drain([&taken](const Packet& packet) {
      taken.emplace_back(index_of(packet.source), packet.payload.empty() ? -1 : static_cast<int>(packet.payload.front()));
    });
    return taken;
  }

  LocalMemory memory;
  Mailbox mailbox;
  AwakeCount awake{2};
};

using Taken = std::vector<std::pair<std::uint32_t, int>>;

TEST_CASE("a new mailbox is empty and gives nothing") {
  OneMailbox box({.small_slots = 1});
  CHECK(box.mailbox.is_empty());
  CHECK_FALSE(box.mailbox.has_packets());
  CHECK(box.take().empty());
}

TEST_CASE("a mailbox takes exactly what it says of the local memory") {
  for (const MailboxCapacity& capacity :
       {MailboxCapacity{}, MailboxCapacity{1, 0, 0}, MailboxCapacity{7, 3, 1000}, MailboxCapacity{7, 3, 1000, 4}}) {
    OneMailbox box(capacity);
    CHECK(box.memory.used()[Category::mailbox] == capacity.bytes());
  }
}

TEST_CASE("a packet comes out as it went in") {
  OneMailbox box({.small_slots = 1});
  CHECK(box.push(3, {std::byte{1}, std::byte{2}}, 9));
  CHECK(box.mailbox.has_packets());
  std::size_t count = box.mailbox.drain([](const Packet& packet) {
    CHECK(packet.source == NodeId{3});
    CHECK(packet.kind == 9);
    CHECK(packet.payload.size() == 2);
    CHECK(packet.payload[1] == std::byte{2});
  });
  CHECK(count == 1);
  CHECK(box.mailbox.is_empty());
}

TEST_CASE("packets of a batch come out when it is handed over, in their order, behind those that came before") {
  OneMailbox box({.small_slots = 4});
  Mailbox::Batch batch;
  for (const std::byte number : {std::byte{1}, std::byte{2}}) {
    const std::vector<std::byte> payload{number};
    CHECK(box.mailbox.add(batch, {.bytes = 1, .source = 7, .kind = 0}, payload));
  }
  CHECK(box.mailbox.is_empty());
  CHECK(box.push_number(8, 3));
  CHECK(box.take() == Taken{{8, 3}});
  CHECK(box.push_number(8, 4));
  box.mailbox.hand_over(batch, box.awake);
  CHECK(batch.is_empty());
  CHECK(box.push_number(8, 5));
  CHECK(box.take() == Taken{{8, 4}, {7, 1}, {7, 2}, {8, 5}});
}

TEST_CASE("a batch of nothing wakes nobody, and one of packets counts a sleeper once") {
  OneMailbox box({.small_slots = 2});
  Mailbox::Batch batch;
  REQUIRE(box.mailbox.fall_asleep());
  CHECK_FALSE(box.awake.leave());
  box.mailbox.hand_over(batch, box.awake);
  CHECK_FALSE(box.mailbox.has_packets());
  CHECK(box.mailbox.add(batch, {}, {}));
  CHECK(box.mailbox.add(batch, {}, {}));
  box.mailbox.hand_over(batch, box.awake);
  box.mailbox.wait();  // returns at once
  CHECK(box.take().size() == 2);
  CHECK_FALSE(box.awake.leave());
  CHECK(box.awake.leave());
}

TEST_CASE("a packet that comes while others are received waits for the next time") {
  OneMailbox box({.small_slots = 2});
  CHECK(box.push_number(1, 1));
  CHECK(box.mailbox.drain([&box](const Packet&) { CHECK(box.push_number(1, 2)); }) == 1);
  CHECK(box.take() == Taken{{1, 2}});
}

TEST_CASE("a full mailbox refuses a packet and loses none") {
  OneMailbox box({.small_slots = 2});
  for (std::uint8_t i = 0; i < 3; ++i) {  // the capacity, and the slot that is spare while no packet is being received
    CHECK(box.push_number(1, i));
  }
  CHECK_FALSE(box.push_number(1, 3));
  CHECK(box.take() == Taken{{1, 0}, {1, 1}, {1, 2}});
  CHECK(box.push_number(1, 4));
  CHECK(box.take() == Taken{{1, 4}});
}

TEST_CASE("as many packets as the capacity fit even while one is being received") {
  OneMailbox box({.small_slots = 2});
  CHECK(box.push_number(1, 0));
  box.mailbox.drain([&box](const Packet&) {
    CHECK(box.push_number(1, 1));
    CHECK(box.push_number(1, 2));
    CHECK_FALSE(box.push_number(1, 3));
  });
  CHECK(box.take() == Taken{{1, 1}, {1, 2}});
}

TEST_CASE("the classes have slots of their own") {
  OneMailbox box({.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 1024});
  const std::vector<std::byte> page(1024, std::byte{5});
  CHECK(box.push(1, page));
  CHECK(box.push(1, page));
  CHECK_FALSE(box.push(1, page));
  CHECK(box.push_number(1, 6));
  CHECK(box.take() == Taken{{1, 5}, {1, 5}, {1, 6}});
}

TEST_CASE("the address of an immutable end takes the slot of its bytes, and the packet comes out with the end where it is") {
  const std::vector<std::byte> front(4, std::byte{3}), page(1024, std::byte{5});
  OneMailbox box({.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = front.size() + page.size()});
  Mailbox::Batch batch;
  const auto add = [&](std::span<const std::byte> end) {
    const auto bytes = static_cast<std::uint32_t>(front.size() + end.size());
    return box.mailbox.add_in_place(batch, {.bytes = bytes, .source = 7, .kind = 9}, front, end);
  };
  CHECK(add(page));
  CHECK(add(page));
  CHECK_FALSE(add(page));
  CHECK(add(std::span(page).first(16)));  // of both a small slot has room
  CHECK_THROWS_AS(static_cast<void>(add(std::span(page).first(15))), core::InternalError);
  box.mailbox.hand_over(batch, box.awake);
  CHECK(box.push(7, {std::byte{6}}, 9));
  std::vector<std::size_t> ends;
  box.mailbox.drain([&](const Packet& packet) {
    CHECK(packet.source == NodeId{7});
    CHECK(packet.kind == 9);
    CHECK((packet.immutable.empty() || packet.immutable.data() == page.data()));
    CHECK((packet.immutable.empty() || std::equal(packet.payload.begin(), packet.payload.end(), front.begin(), front.end())));
    ends.push_back(packet.immutable.size());
  });
  CHECK(ends == std::vector<std::size_t>{1024, 1024, 16, 0});
}

TEST_CASE("a payload that just fits a small slot takes one, and one byte more takes a bulk slot") {
  OneMailbox box({.small_slots = 0, .bulk_slots = 4, .bulk_payload_bytes = 64});
  CHECK_FALSE(box.push(1, std::vector<std::byte>(small_payload_bytes)));
  CHECK(box.push(1, std::vector<std::byte>(small_payload_bytes + 1)));
}

TEST_CASE("a front stands before the payload, and the small class holds as much more as is asked for") {
  OneMailbox box({.small_slots = 1, .small_front_bytes = 4});
  const std::vector<std::byte> front(4, std::byte{7}), payload(small_payload_bytes, std::byte{8});
  CHECK(box.mailbox.push({.bytes = small_payload_bytes + 4}, payload, box.awake, front));
  box.mailbox.drain([](const Packet& packet) {
    CHECK(packet.payload.size() == small_payload_bytes + 4);
    CHECK(packet.payload[3] == std::byte{7});
    CHECK(packet.payload[4] == std::byte{8});
  });
}

TEST_CASE("packets that are not accepted are offered again, in order, before later ones, and keep their slots") {
  OneMailbox box({.small_slots = 2});
  for (std::uint8_t i = 0; i < 3; ++i) {
    CHECK(box.push_number(1, i));
  }
  std::vector<int> offered;
  std::size_t accepted = 1;
  const auto accept = [&](const Packet& packet) {
    offered.push_back(static_cast<int>(packet.payload.front()));
    return accepted-- > 0;
  };
  CHECK_FALSE(box.mailbox.drain_while(accept));
  CHECK_FALSE(box.mailbox.is_drained());
  CHECK(box.push_number(1, 3));
  CHECK_FALSE(box.push_number(1, 4));
  accepted = 9;
  CHECK(box.mailbox.drain_while(accept));  // what has come meanwhile is for the next call
  CHECK_FALSE(box.mailbox.is_drained());
  CHECK(box.mailbox.drain_while(accept));
  CHECK(box.mailbox.is_drained());
  CHECK(offered == std::vector{0, 1, 1, 2, 3});
}

TEST_CASE("a sleep with an end leaves the receiver awake, whether something came or not") {
  OneMailbox box({.small_slots = 1});
  CHECK(box.mailbox.fall_asleep());
  box.mailbox.wait(std::chrono::microseconds(10));
  CHECK(box.mailbox.is_empty());
  CHECK(box.mailbox.fall_asleep());
  CHECK(box.push_number(1, 1));
  box.mailbox.wait(std::chrono::microseconds(10));
  CHECK(box.take() == Taken{{1, 1}});
}

TEST_CASE("a payload may be empty") {
  OneMailbox box({.small_slots = 1});
  CHECK(box.push(4, {}));
  CHECK(box.take() == Taken{{4, -1}});
}

TEST_CASE("a payload that no slot can hold is a broken invariant") {
  OneMailbox box({.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 100});
  CHECK_THROWS_AS(static_cast<void>(box.push(1, std::vector<std::byte>(101))), core::InternalError);
  CHECK_THROWS_AS(static_cast<void>(box.mailbox.push({.bytes = 2}, {}, box.awake)), core::InternalError);
}

TEST_CASE("slots come back however often they are used") {
  OneMailbox box({.small_slots = 1, .bulk_slots = 1, .bulk_payload_bytes = 60});
  for (int i = 0; i < 1000; ++i) {
    REQUIRE(box.push_number(1, 1));
    REQUIRE(box.push(1, std::vector<std::byte>(60)));
    REQUIRE(box.take().size() == 2);
  }
}

TEST_CASE("a pool that is made writes no link, and gives its slots in their order, then those that came back") {
  using Pool = BasicSlotPool<SystemAtomics>;
  Pool::Head head;
  std::array<std::atomic<SlotIndex>, 5> links{};
  std::array<std::byte, 3 * 64> bytes{};
  Pool pool(head, links, 1, bytes, 64);
  CHECK(std::all_of(links.begin(), links.end(), [](const auto& link) { return link.load() == 0; }));
  CHECK(pool.take() == 1);
  CHECK(pool.take() == 2);
  pool.give(1);
  CHECK(pool.take() == 1);
  CHECK(pool.take() == 3);
  CHECK(pool.take() == no_slot);
  pool.give(2);
  pool.give(3);
  CHECK(pool.take() == 3);
  CHECK(pool.take() == 2);
  CHECK(pool.take() == no_slot);
}

TEST_CASE("the tag of the free list may wrap around") {
  using Pool = BasicSlotPool<SystemAtomics>;
  constexpr std::uint64_t last_tag = 0xFFFFFFFF;
  Pool::Head head{last_tag << 32U | no_slot};
  std::array<std::atomic<SlotIndex>, 2> links{};
  std::array<std::byte, 128> bytes{};
  Pool pool(head, links, 0, bytes, 64);
  for (int i = 0; i < 3; ++i) {
    const SlotIndex first = pool.take();
    const SlotIndex second = pool.take();
    CHECK(first + second == 1);
    CHECK(pool.take() == no_slot);
    pool.give(first);
    pool.give(second);
  }
  CHECK((head.word.load() >> 32U) == 5);
}

TEST_CASE("a receiver with a packet does not fall asleep") {
  OneMailbox box({.small_slots = 1});
  CHECK(box.push_number(1, 1));
  CHECK_FALSE(box.mailbox.fall_asleep());
  CHECK(box.take().size() == 1);
  CHECK(box.mailbox.fall_asleep());
}

TEST_CASE("a packet to a sleeper counts it as awake and ends its sleep") {
  OneMailbox box({.small_slots = 1});
  REQUIRE(box.mailbox.fall_asleep());
  CHECK_FALSE(box.awake.leave());
  CHECK_FALSE(box.mailbox.has_packets());
  CHECK(box.push_number(1, 1));
  box.mailbox.wait();  // returns at once
  CHECK(box.take() == Taken{{1, 1}});
  CHECK_FALSE(box.awake.leave());
  CHECK(box.awake.leave());
}

/// As in real runs, but whoever has put a packet into a mailbox is stopped for ever before the wake-up.
struct StoppedSenders : SystemAtomics {
  static void wake(const Atomic<std::uint32_t>& /*word*/) {}
};

TEST_CASE("a sleeper finds a packet whose sender stopped before the wake-up") {
  const MailboxCapacity capacity{.small_slots = 1};
  LocalMemory memory(OneMailbox::plan_for(capacity));
  BasicMailbox<StoppedSenders> mailbox(capacity, memory);
  BasicAwakeCount<StoppedSenders> awake(2);
  REQUIRE(mailbox.fall_asleep());
  std::atomic<bool> has_ended = false;
  std::thread receiver([&] {
    mailbox.wait();
    has_ended = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // the receiver most probably sleeps
  CHECK(mailbox.push({}, {}, awake));
  for (int i = 0; i < 1000 && !has_ended; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(has_ended);
  has_ended ? receiver.join() : receiver.detach();
  CHECK(mailbox.has_packets());
}

TEST_CASE("the links of small and of bulk slots lie on different cache lines") {
  // The inbox, two heads, two slots of each class; and the links.
  CHECK(MailboxCapacity{1, 1, 56}.bytes() == (1 + 2 + 2 + 2) * 64 + 2 * 64);
  CHECK(MailboxCapacity{16, 1, 56}.bytes() == (1 + 2 + 17 + 2) * 64 + 3 * 64);
}

TEST_CASE("a roused sleeper finds nothing and is not counted") {
  OneMailbox box({.small_slots = 1});
  REQUIRE(box.mailbox.fall_asleep());
  CHECK_FALSE(box.awake.leave());
  box.mailbox.rouse();
  box.mailbox.wait();  // returns at once
  CHECK(box.mailbox.is_empty());
  CHECK(box.awake.leave());
}

}  // namespace
}  // namespace dmpc::nodes::mailbox_test
