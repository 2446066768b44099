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
  std::uint32_t take() { return dataflow::pixel_in(queue.take(taken_from)); }

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
    std::vector<std::uint32_t> taken{dataflow::pixel_in(backlog.queue.take(sender))};
    while (backlog.queue.has_alike()) {
      taken.push_back(dataflow::pixel_in(backlog.queue.take_alike(sender)));
    }
    CHECK(taken == alike);
    CHECK(sender == 0);
    CHECK_THROWS_AS(backlog.queue.take_alike(sender), core::InternalError);
  }
  CHECK(backlog.queue.empty());
}

TEST_CASE("with kinds apart every place is there, however rays are spread over depths and kinds") {
  std::mt19937 random(2);
  constexpr std::uint32_t packets = 7, batch = 5, depths = 6;
  Backlog backlog({.sender_count = 1,
                   .packets_each = packets,
                   .packets = packets,
                   .ray_batch = batch,
                   .depth_max = depths,
                   .are_kinds_apart = true});
  for (int round = 0; round < 500; ++round) {
    while (backlog.queue.size() + batch <= packets * batch) {
      backlog.queue.accept_packet(0, batch);
      for (std::uint32_t i = 0; i < batch; ++i) {
        RayMessage message;
        message.ray.depth = static_cast<std::uint8_t>(1 + random() % depths);
        message.ray.kind = random() % 2 == 0 ? core::RayKind::shadow : core::RayKind::refracted;
        message.ray.pixel = 100 * message.ray.depth + (message.ray.kind == core::RayKind::shadow ? 1 : 0);
        backlog.queue.put(0, message);
      }
    }
    for (const auto left = static_cast<std::uint32_t>(random() % (packets * batch)); backlog.queue.size() > left;) {
      const std::uint32_t deepest = backlog.take();
      if (backlog.queue.has_alike() && backlog.queue.size() > left) {
        CHECK(dataflow::pixel_in(backlog.queue.take_alike(backlog.taken_from)) == deepest);
      }
    }
    backlog.queue.gave_back(0, backlog.queue.owed(0));
  }
}

TEST_CASE("with kinds apart there is room where each list that is used has a group that is not full, and for no more") {
  constexpr std::uint32_t packets = 7, batch = 5, depths = 6;
  const RayQueue::Capacity capacity{.sender_count = 1,
                                    .packets_each = packets,
                                    .packets = packets,
                                    .ray_batch = batch,
                                    .depth_max = depths,
                                    .are_kinds_apart = true};
  Backlog backlog(capacity);
  for (std::uint32_t i = 0; i < packets * batch; ++i) {  // one in each of twelve lists, the other 23 in the first
    if (i % batch == 0) {
      backlog.queue.accept_packet(0, batch);
    }
    RayMessage message;
    message.ray.depth = static_cast<std::uint8_t>(i < 2 * depths ? 1 + i / 2 : 1);
    message.ray.kind = i < 2 * depths && i % 2 == 1 ? core::RayKind::shadow : core::RayKind::refracted;
    backlog.queue.put(0, message);
  }
  CHECK(capacity.groups() == 11 + 2);
  CHECK(backlog.queue.size() == packets * batch);
  const RayQueue::Capacity few{.packets = 1, .ray_batch = 5, .depth_max = 30, .are_kinds_apart = true};
  CHECK(few.groups() == 5);
}

}  // namespace ray_queue_test
