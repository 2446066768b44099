#include "dataflow/rays/gather.h"

#include <doctest/doctest.h>

#include <cstring>

#include "core/base/expect.h"
#include "nodes/threads/threads_runner.h"
#include "tests/support/shuffled_machine.h"

namespace gather_test {

using namespace dmpc;
using dataflow::Gather;
using dataflow::Kind;
using dataflow::RayMessage;
using dataflow::RayPacketHeader;
using dataflow::Way;
using nodes::NodeId;

namespace {

/// Node 1 of some, with a gather.
struct RaySender {
  explicit RaySender(const Gather::Capacity& capacity)
      : single(plan_for(capacity), 1, capacity.node_count + 1), gather(single.node, capacity) {}

  static nodes::MemoryPlan plan_for(const Gather::Capacity& capacity) {
    return Gather::layout(capacity) + nodes::credit_table(capacity.node_count + 1);
  }
  void add(std::uint32_t owner, std::uint32_t pixel) {
    RayMessage message;
    message.ray.pixel = pixel;
    gather.add(NodeId{owner}, message);
  }

  tests::SingleNode single;
  Gather gather;
};

RayPacketHeader header_of(const tests::Parcel& parcel) {
  RayPacketHeader header;
  std::memcpy(&header, parcel.payload.data(), sizeof(header));
  return header;
}

std::uint32_t pixel_in(const tests::Parcel& parcel, std::uint32_t index) {
  RayMessage message;
  std::memcpy(static_cast<void*>(&message), parcel.payload.data() + dataflow::ray_packet_bytes(index),
              dataflow::ray_message_bytes(0));
  return message.ray.pixel;
}

constexpr NodeId host{3};

}  // namespace

TEST_CASE("a packet waits when it is full, and carries its rays to their owner in order") {
  RaySender sender({.node_count = 3, .ray_batch = 2, .ray_credits = 1});
  sender.add(0, 10);
  sender.add(2, 20);
  CHECK_FALSE(sender.gather.waits());
  sender.add(0, 11);
  CHECK(sender.gather.waits());
  CHECK(sender.gather.send() == Way::to_owner);
  CHECK_FALSE(sender.gather.waits());
  const tests::Parcel parcel = sender.single.take();
  CHECK(parcel.target == NodeId{0});
  CHECK(Kind{parcel.kind} == Kind::rays);
  CHECK(header_of(parcel).count == 2);
  CHECK(header_of(parcel).owner == 0);
  CHECK(pixel_in(parcel, 0) == 10);
  CHECK(pixel_in(parcel, 1) == 11);
  CHECK(sender.gather.size() == 1);
  CHECK(sender.single.memory.used().bytes == sender.single.memory.plan().bytes);
}

TEST_CASE("a batch of one is one ray a message") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 1});
  sender.add(2, 5);
  CHECK(sender.gather.waits());
  CHECK(sender.gather.send() == Way::to_owner);
  CHECK(sender.single.take().payload.size() == 128);
}

TEST_CASE("without a credit for the owner a packet goes to the host, named with its owner, and without that it waits") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 1, .host_credits = 1});
  const Way ways[] = {Way::to_owner, Way::to_host, Way::wait};
  for (const Way way : ways) {
    sender.add(2, 7);
    CHECK(sender.gather.send() == way);
  }
  CHECK(sender.single.take().target == NodeId{2});
  const tests::Parcel overflow = sender.single.take();
  CHECK(overflow.target == host);
  CHECK(Kind{overflow.kind} == Kind::overflow);
  CHECK(header_of(overflow).owner == 2);
  CHECK(sender.gather.waits());
  CHECK_THROWS_AS(sender.add(0, 8), core::InternalError);
  sender.gather.credits_returned(host, 1);
  CHECK(sender.gather.send() == Way::to_host);
  CHECK(sender.gather.counters().packets == 3);
  CHECK(sender.gather.counters().rays_overflowed == 2);
}

TEST_CASE("packets without credit are queued for their owners and leave in order when credits come") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 1, .queue_packets = 3});
  const Way ways[] = {Way::to_owner, Way::to_queue, Way::to_queue, Way::to_queue, Way::to_host, Way::wait};
  for (std::uint32_t pixel = 0; pixel < 6; ++pixel) {
    sender.add(2, pixel);
    CHECK(sender.gather.send() == ways[pixel]);
  }
  CHECK(sender.gather.queued() == 3);
  CHECK(sender.gather.size() == 4);
  CHECK(pixel_in(sender.single.take(), 0) == 0);
  CHECK(pixel_in(sender.single.take(), 0) == 4);
  CHECK(sender.gather.credits_returned(NodeId{2}, 2) == 2);
  CHECK(pixel_in(sender.single.take(), 0) == 1);
  CHECK(pixel_in(sender.single.take(), 0) == 2);
  CHECK(sender.gather.queued() == 1);
  CHECK(sender.gather.send() == Way::to_queue);
  CHECK(sender.gather.credits_returned(NodeId{2}, 5) == 2);
  CHECK(pixel_in(sender.single.take(), 0) == 3);
  CHECK(pixel_in(sender.single.take(), 0) == 5);
  CHECK(sender.gather.empty());
  CHECK(sender.gather.counters().packets_queued == 4);
  CHECK(sender.gather.counters().queue_high_water == 3);
  CHECK(sender.single.memory.used().bytes == sender.single.memory.plan().bytes);
}

TEST_CASE("a credit for one owner sends nothing that is queued for another") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 1, .queue_packets = 2});
  for (const std::uint32_t owner : {0U, 2U, 0U, 2U}) {
    sender.add(owner, owner);
    sender.gather.send();
  }
  CHECK(sender.gather.queued() == 2);
  CHECK(sender.gather.credits_returned(host, 1) == 0);
  CHECK(sender.gather.credits_returned(NodeId{0}, 1) == 1);
  CHECK(sender.gather.queued() == 1);
}

TEST_CASE("without credits between nodes nothing is queued and all rays go by way of the host") {
  RaySender sender({.node_count = 3, .ray_batch = 2, .ray_credits = 0, .host_credits = 2, .queue_packets = 2});
  sender.add(0, 1);
  CHECK(sender.gather.can_flush());
  sender.gather.flush();
  CHECK(sender.gather.send() == Way::to_host);
  sender.add(0, 1);
  sender.add(0, 1);
  CHECK(sender.gather.send() == Way::to_host);
}

TEST_CASE("the fullest packet is flushed first") {
  RaySender sender({.node_count = 3, .ray_batch = 4, .ray_credits = 1});
  CHECK_FALSE(sender.gather.can_flush());
  CHECK_THROWS_AS(sender.gather.flush(), core::InternalError);
  sender.add(0, 1);
  sender.add(2, 2);
  sender.add(2, 3);
  sender.gather.flush();
  sender.gather.send();
  CHECK(sender.single.take().target == NodeId{2});
  sender.gather.flush();
  sender.gather.send();
  CHECK(header_of(sender.single.take()).count == 1);
  CHECK(sender.gather.empty());
  CHECK(sender.gather.counters().packets_flushed == 2);
}

TEST_CASE("a packet that is not full waits for its owner's credit and does not overflow") {
  RaySender sender({.node_count = 3, .ray_batch = 2, .ray_credits = 1, .queue_packets = 1});
  sender.add(0, 1);
  sender.gather.flush();
  sender.gather.send();
  sender.add(0, 2);
  CHECK_FALSE(sender.gather.can_flush());
  CHECK(sender.gather.credits_returned(NodeId{0}, 1) == 0);
  CHECK(sender.gather.can_flush());
}

TEST_CASE("a shared place is asked for with the first ray, once, and again for what is left when it is used") {
  RaySender sender({.node_count = 3, .ray_batch = 2, .ray_credits = 0, .shares_slots = true, .queue_packets = 2});
  sender.add(0, 1);
  const tests::Parcel request = sender.single.take();
  CHECK(request.target == NodeId{0});
  CHECK(Kind{request.kind} == Kind::ask);
  CHECK(sender.gather.is_unanswered());
  CHECK_FALSE(sender.gather.can_flush());
  sender.add(0, 2);
  CHECK(sender.gather.send() == Way::to_queue);
  sender.add(0, 3);
  CHECK(sender.single.post.parcels.empty());
  CHECK(sender.gather.credits_returned(NodeId{0}, 1) == 1);
  CHECK(pixel_in(sender.single.take(), 1) == 2);
  CHECK(Kind{sender.single.take().kind} == Kind::ask);
  CHECK(sender.gather.credits_returned(NodeId{0}, 1) == 0);
  CHECK_FALSE(sender.gather.is_unanswered());
  sender.gather.flush();
  CHECK(sender.gather.send() == Way::to_owner);
  CHECK(pixel_in(sender.single.take(), 0) == 3);
  CHECK(sender.single.post.parcels.empty());
  CHECK(sender.gather.empty());
  CHECK_THROWS_AS(sender.gather.credits_returned(NodeId{0}, 1), core::InternalError);
}

TEST_CASE("a shared place goes back unused, and counts as a packet, if its rays have gone by way of the host") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 0, .shares_slots = true, .host_credits = 1});
  sender.add(2, 1);
  CHECK(Kind{sender.single.take().kind} == Kind::ask);
  CHECK(sender.gather.send() == Way::to_host);
  CHECK(sender.single.take().target == host);
  CHECK(sender.gather.is_unanswered());
  CHECK(sender.gather.credits_returned(NodeId{2}, 1) == 1);
  const tests::Parcel unused = sender.single.take();
  CHECK(unused.target == NodeId{2});
  CHECK(Kind{unused.kind} == Kind::unused);
  CHECK(unused.payload.size() > nodes::small_payload_bytes);
  CHECK(sender.single.node.credits(NodeId{2}, dataflow::ray_channel) == 0);
  CHECK_FALSE(sender.gather.is_unanswered());
}

TEST_CASE("no more owners are asked at once than there are packets, and each answer lets the next be asked, in turn") {
  RaySender sender(
      {.node_count = 6, .ray_batch = 1, .ray_credits = 0, .shares_slots = true, .open_packets = 2, .host_credits = 9});
  for (const std::uint32_t owner : {0U, 2U}) {
    sender.add(owner, owner);
    CHECK(Kind{sender.single.take().kind} == Kind::ask);
    CHECK(sender.gather.send() == Way::to_host);
    CHECK(sender.single.take().target == NodeId{6});
  }
  sender.add(3, 3);  // two owners are asked, and have no rays any more
  CHECK(sender.single.post.parcels.empty());
  CHECK(sender.gather.credits_returned(NodeId{2}, 1) == 1);
  const tests::Parcel next = sender.single.take();
  CHECK(Kind{next.kind} == Kind::ask);
  CHECK(next.target == NodeId{3});
  CHECK(Kind{sender.single.take().kind} == Kind::unused);
  CHECK(sender.gather.credits_returned(NodeId{0}, 1) == 1);
  CHECK(sender.gather.credits_returned(NodeId{3}, 1) == 0);
  CHECK_FALSE(sender.gather.is_unanswered());
  CHECK(sender.gather.send() == Way::to_owner);
}

TEST_CASE("with as many packets open as there is room for the fullest is closed, preferably one that may leave") {
  RaySender sender({.node_count = 4, .ray_batch = 9, .ray_credits = 1, .open_packets = 2, .queue_packets = 1});
  sender.add(0, 1);
  sender.add(0, 2);
  CHECK_FALSE(sender.gather.waits());
  sender.add(2, 3);
  CHECK(sender.gather.send() == Way::to_owner);
  CHECK(header_of(sender.single.take()).count == 2);
  sender.add(0, 4);  // without credit now: that of 2 may leave
  CHECK(sender.gather.send() == Way::to_owner);
  CHECK(sender.single.take().target == NodeId{2});
  sender.add(2, 5);  // none may leave: one is queued
  CHECK(sender.gather.send() == Way::to_queue);
  CHECK(sender.gather.queued() == 1);
  CHECK(sender.gather.counters().packets_flushed == 3);
  CHECK(sender.single.memory.used().bytes == sender.single.memory.plan().bytes);
}

TEST_CASE("no ray leaves for its own node or for the host") {
  RaySender sender({.node_count = 3, .ray_batch = 1, .ray_credits = 1});
  CHECK_THROWS_AS(sender.add(1, 1), core::InternalError);
  CHECK_THROWS_AS(sender.add(3, 1), core::InternalError);
}

}  // namespace gather_test
