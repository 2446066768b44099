#include "nodes/virtual/event_queue.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <random>
#include <set>

#include "core/base/expect.h"

namespace dmpc::tests::event_queue_test {
namespace {

using nodes::Event;
using nodes::EventQueue;

Event at(std::uint64_t time_ns, std::uint32_t source, std::uint64_t sequence) {
  return {.order = Event::order_of(time_ns, nodes::NodeId{source}, sequence)};
}

bool is_next(EventQueue& queue, const Event& event) { return queue.pop().order == event.order; }

}  // namespace

TEST_CASE("events come by time, then by source, then by the source's own count") {
  EventQueue queue;
  const std::array ordered{at(3, 9, 9), at(4, 0, 7), at(4, 1, 2), at(4, 1, 3), at(4, 2, 0), at(5, 0, 0)};
  for (const std::size_t i : {4U, 2U, 0U, 5U, 3U, 1U}) {
    queue.push(ordered[i]);
  }
  for (const Event& event : ordered) {
    CHECK(is_next(queue, event));
    CHECK(queue.now_ns() == event.time_ns());
  }
  CHECK(queue.empty());
}

TEST_CASE("an event keeps what it is about") {
  EventQueue queue;
  queue.push({.order = Event::order_of(1, nodes::NodeId{3}, 2), .kind = Event::Kind::arrives, .packet = 4});
  const Event event = queue.pop();
  CHECK(event.time_ns() == 1);
  CHECK(event.source() == 3);
  CHECK(event.kind == Event::Kind::arrives);
  CHECK(event.packet == 4);
}

TEST_CASE("nothing is pushed before now, but now will do") {
  EventQueue queue;
  for (const std::uint64_t sequence : {0U, 1U}) {
    queue.push(at(10, 0, sequence));
  }
  queue.pop();
  queue.push(at(10, 0, 1));
  CHECK_THROWS_AS(queue.push(at(9, 0, 2)), core::InternalError);
  CHECK(is_next(queue, at(10, 0, 1)));
  CHECK(is_next(queue, at(10, 0, 1)));
  CHECK(queue.empty());
}

TEST_CASE("an event that comes in place of the one popped, or one after it, has its turn") {
  EventQueue queue;
  for (const std::uint32_t source : {0U, 1U, 2U, 3U}) {
    queue.push(at(10 + source, source, 0));
  }
  CHECK(is_next(queue, at(10, 0, 0)));
  queue.push(at(12, 0, 1));
  queue.push(at(11, 0, 2));
  CHECK(is_next(queue, at(11, 0, 2)));
  CHECK(is_next(queue, at(11, 1, 0)));
  CHECK(is_next(queue, at(12, 0, 1)));
  CHECK(is_next(queue, at(12, 2, 0)));
  CHECK_FALSE(queue.empty());
  CHECK(is_next(queue, at(13, 3, 0)));
  CHECK(queue.empty());
}

TEST_CASE("an empty queue has no least event") {
  EventQueue queue;
  CHECK(queue.empty());
  CHECK(queue.now_ns() == 0);
  CHECK_THROWS_AS(queue.pop(), core::InternalError);
}

TEST_CASE("whatever the order of pushes and pops, and however far apart the events, they come out in theirs") {
  for (const std::uint64_t slot_ns : {1U, 5U, 1000U}) {
    for (const std::uint64_t distance_max_ns : {1U, 8U, 700U, 5'000U, 2'000'000U}) {
      std::mt19937_64 random(5);
      EventQueue queue(slot_ns);
      std::set<Event::Order> waiting;
      for (std::uint64_t i = 0; i < 4'000; ++i) {
        if (waiting.empty() || random() % 20 < 11) {
          const Event event = at(queue.now_ns() + random() % distance_max_ns, static_cast<std::uint32_t>(random() % 4), i);
          waiting.insert(event.order);
          queue.push(event);
        } else {
          REQUIRE((queue.pop().order == *waiting.begin()));
          REQUIRE(queue.now_ns() == static_cast<std::uint64_t>(*waiting.begin() >> 64U));
          waiting.erase(waiting.begin());
        }
      }
      for (const Event::Order order : waiting) {
        REQUIRE((queue.pop().order == order));
      }
      CHECK(queue.empty());
    }
  }
}

TEST_CASE("any number of events of one time come by their sources, in whatever order they were pushed") {
  EventQueue queue(8);
  for (std::uint32_t source = 0; source < 1000; ++source) {
    queue.push(at(3, source * 7 % 1000, 0));
  }
  for (std::uint32_t source = 0; source < 1000; ++source) {
    REQUIRE(is_next(queue, at(3, source, 0)));
  }
  CHECK(queue.empty());
}

}  // namespace dmpc::tests::event_queue_test
