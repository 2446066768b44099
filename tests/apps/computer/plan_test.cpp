#include "apps/computer/plan.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/expect.h"
#include "nodes/chaos.h"

namespace dmpc::apps::computer_plan_test {

namespace {

/// Requests with answers round the ring, longer than a small place; one packet from everybody to everybody.
Needs ring_needs() {
  return {.packets = {{.name = "block", .bytes_max = 1000, .senders = from_previous(3)},
                      {.name = "taken", .answers = "block"},
                      {.name = "greeting", .senders = from_each_other()}},
          .operations = {{"step", 2}},
          .memory = {{"cells", 100}, {"more", 64}}};
}

nodes::ComputerRequest computer_of(std::uint32_t node_count) { return {.node_count = node_count}; }

void check_refused(const Needs& needs, const char* message) {
  CHECK_THROWS_WITH_AS(ProgramPlan(needs, computer_of(4)), doctest::Contains(message), core::UsageError);
}

}  // namespace

TEST_CASE("a mailbox has a place for all that may be under way to its node, answers included") {
  const ProgramPlan plan(ring_needs(), computer_of(4));
  for (std::uint32_t node = 0; node < 4; ++node) {
    // A block may be short: then it lies in a small place.
    CHECK(plan.mailbox(node).small_slots == 3 + 3 + 3);
    CHECK(plan.mailbox(node).bulk_slots == 3);
    CHECK(plan.mailbox(node).bulk_payload_bytes == 1000);
  }
}

TEST_CASE("who sends nobody gets no credit, and answers are not credited but owed") {
  const ProgramPlan plan(ring_needs(), computer_of(4));
  CHECK(plan.credits(0, 1, 0) == 3);
  CHECK(plan.credits(1, 0, 0) == 0);
  CHECK(plan.credits(3, 0, 0) == 3);
  CHECK(plan.credits(0, 1, 1) == 0);
  CHECK(plan.credits(0, 0, 2) == 0);
  CHECK(plan.answer_of(0) == Index{1});
  CHECK(plan.request_of(1) == Index{0});
  CHECK_FALSE(plan.answer_of(2));
}

TEST_CASE("a node alone is its own neighbour, and has no other") {
  const ProgramPlan plan(ring_needs(), computer_of(1));
  CHECK(plan.credits(0, 0, 0) == 3);
  CHECK(plan.mailbox(0).small_slots == 6);
}

TEST_CASE("one to all and all to one") {
  const ProgramPlan plan({.packets = {{.name = "down", .senders = from_node(1, 2)}, {.name = "up", .senders = to_node(1)}}},
                         computer_of(3));
  CHECK(plan.mailbox(0).small_slots == 2);
  CHECK(plan.mailbox(1).small_slots == 2);
  CHECK(plan.credits(1, 0, 0) == 2);
  CHECK(plan.credits(0, 1, 0) == 0);
  CHECK(plan.credits(2, 1, 1) == 1);
  CHECK(plan.credits(1, 1, 1) == 0);
}

TEST_CASE("a node's memory is the sum of its parts, and one that is too small is refused with what would do") {
  nodes::ComputerRequest computer = computer_of(4);
  const ProgramPlan plan(ring_needs(), computer);
  CHECK(plan.memory(2)[ProgramMemory::declared] == 128 + 64);
  const std::size_t needed = plan.memory(2).total();
  computer.node_memory_bytes = needed;
  CHECK_NOTHROW(ProgramPlan(ring_needs(), computer));
  computer.node_memory_bytes = needed - 1;
  CHECK_THROWS_WITH_AS(ProgramPlan(ring_needs(), computer),
                       doctest::Contains(("a node takes " + std::to_string(needed) + " bytes").c_str()), core::CapacityError);
}

TEST_CASE("what is declared beyond the memory of any computer is refused by its name, and no sum of it wraps") {
  for (const std::size_t bytes : {(std::size_t{1} << 30) + 1, SIZE_MAX - 200, SIZE_MAX}) {
    Needs needs = ring_needs();
    needs.packets[0].bytes_max = bytes;
    check_refused(needs, "the packet 'block' has up to ");
  }
  for (const std::size_t bytes : {(std::size_t{1} << 40) + 1, SIZE_MAX - 30, SIZE_MAX}) {
    Needs needs = ring_needs();
    needs.memory[1].bytes = bytes;
    check_refused(needs, "the memory 'more' has ");
  }
  Needs needs = ring_needs();
  needs.packets[0].bytes_max = std::size_t{1} << 30;
  needs.packets[0].senders = from_each_other(16'000);
  CHECK_THROWS_AS(ProgramPlan(needs, computer_of(1024)), core::CapacityError);
}

TEST_CASE("bytes of more values than can be addressed are the most that can") {
  CHECK(bytes_of<double>(0) == 0);
  CHECK(bytes_of<double>(9) == 128);
  CHECK(bytes_of<double>(SIZE_MAX / 8) == SIZE_MAX - 63);
  CHECK(bytes_of<double>(std::size_t{1} << 61) == SIZE_MAX - 63);
  CHECK(bytes_of<char>(SIZE_MAX) == SIZE_MAX - 63);
}

TEST_CASE("chaos takes credits that come back, never the last one, and none that does not") {
  bool has_shrunk = false;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    nodes::ComputerRequest computer = computer_of(4);
    computer.chaos = nodes::chaos_of(seed);
    Needs needs = ring_needs();
    needs.packets[2].senders = from_each_other(9);
    const ProgramPlan plan(needs, computer);
    INFO("seed ", seed);
    CHECK(plan.credits(0, 1, 0) >= 1);
    CHECK(plan.credits(0, 1, 0) <= 3);
    CHECK(plan.credits(0, 1, 2) == 9);
    CHECK(plan.mailbox(0).bulk_slots == 3);
    CHECK(plan.held_bytes() > 1000);
    has_shrunk = has_shrunk || plan.credits(0, 1, 0) < 3;
  }
  CHECK(has_shrunk);
}

TEST_CASE("needs that contradict each other are refused by name") {
  Needs needs = ring_needs();
  needs.packets[2].name = "block";
  check_refused(needs, "two packets are called 'block'");
  needs = ring_needs();
  needs.packets[0].senders = {};
  check_refused(needs, "'block' has no senders and answers none");
  needs = ring_needs();
  needs.packets[1].senders = from_previous();
  check_refused(needs, "'taken' has senders and answers another");
  needs = ring_needs();
  needs.packets[1].answers = "blocks";
  check_refused(needs, "'taken' answers 'blocks': expected a packet that has senders");
  needs = ring_needs();
  needs.packets.push_back({.name = "again", .answers = "block"});
  check_refused(needs, "'again' answers 'block': expected a packet that has senders, and no other answer");
  needs = ring_needs();
  needs.operations.push_back({"step", 1});
  check_refused(needs, "two operations are called 'step'");
  needs = ring_needs();
  needs.operations[0].nanoseconds = -1;
  check_refused(needs, "'step' takes -1 ns");
}

TEST_CASE("a program has as many packets and operations as the computer counts, and no more") {
  Needs needs;
  for (std::size_t i = 0; i < packets_max; ++i) {
    needs.packets.push_back({.name = "p" + std::to_string(i), .senders = from_each_other()});
  }
  for (std::size_t i = 0; i < operations_max; ++i) {
    needs.operations.push_back({"o" + std::to_string(i), 1});
  }
  CHECK_NOTHROW(ProgramPlan(needs, computer_of(2)));
  Needs more = needs;
  more.packets.push_back({.name = "one more", .senders = from_each_other()});
  check_refused(more, "25 packets are declared: a program has at most 24");
  more = needs;
  more.operations.push_back({"one more", 1});
  check_refused(more, "14 operations are declared: a program has at most 13");
  check_refused({.packets = {{.name = "flood", .senders = from_previous(40'000)}}}, "expected at most 32767");
}

}  // namespace dmpc::apps::computer_plan_test
