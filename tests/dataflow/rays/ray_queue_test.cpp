#include "dataflow/rays/ray_queue.h"

#include <doctest/doctest.h>

#include <random>
#include <utility>
#include <vector>

#include "core/base/expect.h"

namespace ray_queue_test {

using namespace dmpc;
using dataflow::RayMessage;
using dataflow::RayQueue;

namespace {

/// A queue in a memory of its own that fits exactly.
struct Backlog {
  explicit Backlog(const RayQueue::Capacity& capacity) : memory(RayQueue::layout(capacity)), queue(memory, capacity) {}

  void receive(std::uint32_t sender, const std::vector<std::uint8_t>& depths) {
    queue.accept_packet(sender, static_cast<std::uint32_t>(depths.size()));
    for (const std::uint8_t depth : depths) {
      RayMessage message;
      message.ray.depth = depth;
      message.ray.pixel = next_pixel++;
      queue.put(sender, message);
    }
  }
  /// Pixel of the ray taken; its sender in `taken_from`.
  std::uint32_t take() { return queue.take(taken_from).ray.pixel; }

  nodes::LocalMemory memory;
  RayQueue queue;
  std::uint32_t next_pixel = 0;
  std::uint32_t taken_from = 99;
};

}  // namespace

TEST_CASE("an empty backlog gives nothing and owes nothing") {
  Backlog backlog({.sender_count = 3, .packets_each = 2, .packets = 4, .ray_batch = 4, .depth_max = 5});
  CHECK(backlog.queue.empty());
  CHECK(backlog.queue.owed(0) == 0);
  CHECK_THROWS_AS(backlog.take(), core::InternalError);
  CHECK(backlog.memory.used().bytes == backlog.memory.plan().bytes);
}

TEST_CASE("the deepest ray comes first, of equally deep ones the newest") {
  Backlog backlog({.sender_count = 3, .packets_each = 2, .packets = 4, .ray_batch = 4, .depth_max = 5});
  backlog.receive(0, {1, 3, 2, 3});
  backlog.receive(2, {5, 1});
  CHECK(backlog.take() == 4);
  CHECK(backlog.taken_from == 2);
  CHECK(backlog.take() == 3);
  CHECK(backlog.taken_from == 0);
  backlog.receive(2, {4});
  const std::uint32_t rest[] = {6, 1, 2, 5, 0};
  for (const std::uint32_t pixel : rest) {
    CHECK(backlog.take() == pixel);
  }
  CHECK(backlog.queue.empty());
  CHECK(backlog.queue.high_water() == 6);
}

TEST_CASE("a credit is owed as soon as the rays left do not fill its packet") {
  Backlog backlog({.sender_count = 2, .packets_each = 3, .packets = 3, .ray_batch = 2, .depth_max = 1});
  backlog.receive(0, {1, 1});
  backlog.receive(0, {1});
  CHECK(backlog.queue.owed(0) == 0);
  backlog.take();
  CHECK(backlog.queue.owed(0) == 1);
  backlog.queue.gave_back(0, 1);
  CHECK(backlog.queue.owed(0) == 0);
  backlog.take();
  CHECK(backlog.queue.owed(0) == 0);
  backlog.take();
  CHECK(backlog.queue.owed(0) == 1);
  CHECK(backlog.queue.owed(1) == 0);
  CHECK_THROWS_AS(backlog.queue.gave_back(0, 2), core::InternalError);
}

TEST_CASE("every sender can fill its places, and not one packet more") {
  Backlog backlog({.sender_count = 3, .packets_each = 2, .packets = 4, .ray_batch = 2, .depth_max = 1});
  for (const std::uint32_t sender : {0U, 2U}) {
    backlog.receive(sender, {1, 1});
    backlog.receive(sender, {1, 1});
    CHECK_THROWS_AS(backlog.queue.accept_packet(sender, 1), core::InternalError);
  }
  CHECK(backlog.queue.size() == 8);
}

TEST_CASE("a packet with no ray, with too many, or with a ray too deep is an error") {
  Backlog backlog({.sender_count = 2, .packets_each = 2, .packets = 2, .ray_batch = 2, .depth_max = 3});
  CHECK_THROWS_AS(backlog.queue.accept_packet(0, 0), core::InternalError);
  CHECK_THROWS_AS(backlog.queue.accept_packet(0, 3), core::InternalError);
  CHECK_THROWS_AS(backlog.receive(0, {4}), core::InternalError);
}

TEST_CASE("whatever comes and goes, a sender within its credits always finds room") {
  std::mt19937 random(1);
  Backlog backlog({.sender_count = 5, .packets_each = 3, .packets = 12, .ray_batch = 4, .depth_max = 6});
  std::uint32_t credits[5] = {3, 3, 3, 3, 0};
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t sender = random() % 4;
    if (credits[sender] > 0 && random() % 3 == 0) {
      --credits[sender];
      backlog.receive(sender, std::vector<std::uint8_t>(1 + random() % 4, static_cast<std::uint8_t>(1 + random() % 6)));
    } else if (!backlog.queue.empty()) {
      backlog.take();
      const std::uint32_t owed = backlog.queue.owed(backlog.taken_from);
      backlog.queue.gave_back(backlog.taken_from, owed);
      credits[backlog.taken_from] += owed;
    }
  }
  while (!backlog.queue.empty()) {
    backlog.take();
    credits[backlog.taken_from] += backlog.queue.owed(backlog.taken_from);
    backlog.queue.gave_back(backlog.taken_from, backlog.queue.owed(backlog.taken_from));
  }
  for (const std::uint32_t sender : {0U, 1U, 2U, 3U}) {
    CHECK(credits[sender] == 3);
  }
}

TEST_CASE("with kinds apart the deepest comes first, then all that are as deep and shadow rays, or not, as it is") {
  Backlog backlog({.sender_count = 2, .packets_each = 1, .packets = 1, .ray_batch = 6, .depth_max = 3, .are_kinds_apart = true});
  CHECK(backlog.memory.used().bytes == backlog.memory.plan().bytes);
  backlog.queue.accept_packet(0, 6);
  const std::pair<int, core::RayKind> rays[] = {{1, core::RayKind::primary}, {3, core::RayKind::reflected},
                                                {1, core::RayKind::shadow},  {3, core::RayKind::shadow},
                                                {3, core::RayKind::shadow},  {3, core::RayKind::refracted}};
  for (const auto& [depth, kind] : rays) {
    RayMessage message;
    message.ray.depth = static_cast<std::uint8_t>(depth);
    message.ray.kind = kind;
    message.ray.pixel = backlog.next_pixel++;
    backlog.queue.put(0, message);
  }
  const std::vector<std::vector<std::uint32_t>> expected{{4, 3}, {5, 1}, {2}, {0}};
  for (const std::vector<std::uint32_t>& alike : expected) {
    std::uint32_t sender = 99;
    const core::Ray first = backlog.queue.take(sender).ray;
    std::vector<std::uint32_t> taken{first.pixel};
    while (backlog.queue.has_alike(first)) {
      taken.push_back(backlog.queue.take_alike(first, sender).ray.pixel);
    }
    CHECK(taken == alike);
    CHECK(sender == 0);
    CHECK_THROWS_AS(backlog.queue.take_alike(first, sender), core::InternalError);
  }
  CHECK(backlog.queue.empty());
}

}  // namespace ray_queue_test
