#include "nodes/virtual/event_queue.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <random>
#include <set>

#include "core/base/expect.h"

namespace dmpc::tests {
namespace {

using nodes::Event;
using nodes::EventQueue;

Event at(std::uint64_t time_ns, std::uint32_t source, std::uint64_t sequence) {
  return {.time_ns = time_ns, .sequence = sequence, .source = source};
}

}  // namespace

TEST_CASE("events come by time, then by source, then by the source's own count") {
  EventQueue queue;
  const std::array ordered{at(3, 9, 9), at(4, 0, 7), at(4, 1, 2), at(4, 1, 3), at(4, 2, 0), at(5, 0, 0)};
  for (const std::size_t i : {4U, 2U, 0U, 5U, 3U, 1U}) {
    queue.push(ordered[i]);
  }
  for (const Event& event : ordered) {
    CHECK(queue.pop().key() == event.key());
    CHECK(queue.now_ns() == event.time_ns);
  }
  CHECK(queue.empty());
}

TEST_CASE("an event keeps what it is about") {
  EventQueue queue;
  queue.push({.time_ns = 1, .sequence = 2, .source = 3, .kind = Event::Kind::arrives, .packet = 4});
  const Event event = queue.pop();
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
  CHECK(queue.pop().key() == at(10, 0, 1).key());
  CHECK(queue.pop().key() == at(10, 0, 1).key());
  CHECK(queue.empty());
}

TEST_CASE("an empty queue has no least event") {
  EventQueue queue;
  CHECK(queue.empty());
  CHECK(queue.now_ns() == 0);
  CHECK_THROWS_AS(queue.pop(), core::InternalError);
}

TEST_CASE("whatever the order of pushes and pops, events come out in theirs") {
  std::mt19937_64 random(5);
  EventQueue queue;
  std::set<decltype(Event{}.key())> waiting;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    if (waiting.empty() || random() % 2 == 0) {
      const Event event = at(queue.now_ns() + random() % 8, static_cast<std::uint32_t>(random() % 4), i);
      waiting.insert(event.key());
      queue.push(event);
    } else {
      REQUIRE(queue.pop().key() == *waiting.begin());
      waiting.erase(waiting.begin());
    }
  }
}

}  // namespace dmpc::tests
