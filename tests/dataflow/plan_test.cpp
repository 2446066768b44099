#include "dataflow/plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/memory_use.h"
#include "dataflow/packets.h"
#include "dataflow/rays/bundle_task.h"
#include "nodes/size_text.h"
#include "tests/support/complaint.h"

namespace dataflow_plan_test {

using namespace dmpc;
using core::operator""_KiB;
using core::operator""_MiB;
using dataflow::make_plan;
using dataflow::Plan;
using dataflow::PlanRequest;

namespace {

PlanRequest request_with(std::uint32_t nodes, std::size_t part_bytes) {
  PlanRequest request{.shares = std::vector<dataflow::Share>(nodes, {part_bytes, 10}), .width = 64, .height = 64};
  return request;
}

/// Nodes whose regions move, of four units each, with so many pages of 1 KiB.
PlanRequest moving_request(std::initializer_list<std::size_t> pages) {
  PlanRequest request{.width = 64, .height = 64};
  request.rays.balance = {.balance = dataflow::Balance::moving, .regions_a_node = 4};
  for (const std::size_t count : pages) {
    request.shares.push_back({.part_bytes = count * 1_KiB, .primary_runs = 10, .page_bytes = 1_KiB});
  }
  return request;
}

std::string error_of(const PlanRequest& request, const dataflow::OtherNodeCount& other = {}) {
  return tests::complaint_of([&] { make_plan(request, other); });
}

}  // namespace

TEST_CASE("without a memory bound a packet of rays fills 2 KiB, on a modelled machine 1 KiB, and there are four credits") {
  const Plan plan = make_plan(request_with(8, 100_KiB));
  CHECK(plan.ray_batch == 17);
  CHECK(dataflow::ray_packet_bytes(plan.ray_batch) <= 2_KiB);
  CHECK(dataflow::ray_packet_bytes(plan.ray_batch + 1) > 2_KiB);
  PlanRequest modelled = request_with(8, 100_KiB);
  modelled.computer.machine.emplace();
  CHECK(make_plan(modelled).ray_batch == 8);
  CHECK(plan.ray_credits == 4);
  CHECK(plan.queue_packets == 512);
  CHECK(plan.notes.empty());
}

TEST_CASE("where places are shared packets of bundles are no longer than those of rays that walk alone") {
  PlanRequest request = request_with(129, 100_KiB);
  request.bundles = true;
  CHECK(make_plan(request).ray_batch == 17);
  CHECK(make_plan(request).rays_a_task == 16);
  request.rays.ray_credits = 4;
  CHECK(make_plan(request).ray_batch == 34);
  request.rays.ray_batch = 40;
  CHECK(make_plan(request).ray_batch == 40);
}

TEST_CASE("bundles have packets of 4 KiB, few nodes more credits, and each node room for 16 rays and their hits") {
  for (const std::uint32_t nodes : {1U, 2U, 8U, 16U, 64U}) {
    CAPTURE(nodes);
    PlanRequest request = request_with(nodes, 100_KiB);
    const Plan alone = make_plan(request);
    request.bundles = true;
    const Plan plan = make_plan(request);
    CHECK(alone.rays_a_task == 1);
    CHECK(plan.rays_a_task == 16);
    CHECK(plan.ray_batch == 34);
    CHECK(dataflow::ray_packet_bytes(34) <= 4_KiB);
    CHECK(plan.ray_credits == std::max(64 / nodes, 4U));
    CHECK(plan.queue_packets == (nodes == 1 ? 0 : 256));
    const nodes::MemoryPlan more = plan.node_memory(0), less = alone.node_memory(0);
    const nodes::MemoryPlan task = dataflow::BundleTask::layout(request.waiting_hits_max);
    CHECK(more[core::MemoryUse::ray_stacks] == task[core::MemoryUse::ray_stacks]);
    CHECK(more[core::MemoryUse::ray_stacks] > less[core::MemoryUse::ray_stacks]);
    CHECK(more[core::MemoryUse::ray_stacks] < 32_KiB);
  }
}

TEST_CASE("where memory is scarce rays walk alone before packets get shorter, and bundles ask for no more memory than that") {
  PlanRequest request = request_with(16, 100_KiB), alone = request;
  request.bundles = true;
  CHECK(dataflow::smallest_node_memory_bytes(request) == dataflow::smallest_node_memory_bytes(alone));
  std::uint32_t rays = 16;
  for (std::size_t memory = make_plan(request).node_memory_max_bytes(); memory >= dataflow::smallest_node_memory_bytes(request);
       memory -= 4_KiB) {
    request.computer.node_memory_bytes = memory;
    const Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= memory);
    CHECK(plan.rays_a_task <= rays);
    CHECK((plan.rays_a_task == 1 || plan.ray_batch == 34));
    CHECK((plan.rays_a_task == 16 || plan.ray_credits == 1));
    rays = plan.rays_a_task;
  }
  CHECK(rays == 1);
  request.computer.node_memory_bytes = dataflow::smallest_node_memory_bytes(request);
  const std::vector<std::string> notes = make_plan(request).notes;
  CHECK(std::any_of(notes.begin(), notes.end(),
                    [](const std::string& note) { return note.starts_with("rays traced together reduced from 16 to 1"); }));
}

TEST_CASE("nodes whose regions move have room for as many pages again as they have on average, and for others' primary rays") {
  PlanRequest request = moving_request({20, 40, 60});
  request.shares[0].primary_runs = 4;
  const Plan plan = make_plan(request);
  CHECK(plan.is_moving());
  CHECK(plan.unit_count() == 12);
  CHECK(plan.spare_frames == 40);
  CHECK(plan.pages_of_node(0).frames == 60);
  CHECK(plan.pages_of_node(2).frames == 100);
  CHECK(plan.primaries_of_node(0).runs == 8);
  CHECK(plan.primaries_of_node(1).runs == 10);
  const Plan still = make_plan(request_with(3, 40_KiB));
  CHECK_FALSE(still.is_moving());
  CHECK(still.unit_count() == 0);
  CHECK(still.spare_frames == 0);
  CHECK(plan.node_mailbox.bulk_slots == still.node_mailbox.bulk_slots + 1);
  CHECK(plan.node_mailbox.small_slots == still.node_mailbox.small_slots + 2 + 1 + 1 + 2 * plan.ray_credits);
}

TEST_CASE("scarce memory costs queued packets before room for units, that before credits, and the smallest has none") {
  PlanRequest request = moving_request({20, 40, 60});
  const std::size_t smallest = dataflow::smallest_node_memory_bytes(request);
  std::uint32_t spare = 40;
  for (std::size_t memory = make_plan(request).node_memory_max_bytes(); memory >= smallest; memory -= 4_KiB) {
    request.computer.node_memory_bytes = memory;
    const Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= memory);
    CHECK((plan.spare_frames == 40 || plan.queue_packets == 0));
    CHECK((plan.spare_frames == 0 || plan.ray_credits == 4));
    CHECK(plan.spare_frames <= spare);
    spare = plan.spare_frames;
  }
  CHECK(spare == 0);
  request.computer.node_memory_bytes = smallest;
  const Plan plan = make_plan(request);
  CHECK(plan.node_memory_max_bytes() == smallest);
  CHECK(std::any_of(plan.notes.begin(), plan.notes.end(), [](const std::string& note) {
    return note.starts_with("pages of units that a node may take reduced from 40 to 0");
  }));
  request.computer.node_memory_bytes = smallest - 1;
  CHECK(error_of(request).find("node_memory_bytes=" + nodes::size_text(smallest)) != std::string::npos);
}

TEST_CASE("the smallest memory that is named works, and one byte less does not") {
  for (const std::uint32_t nodes : {1U, 2U, 7U, 64U}) {
    PlanRequest request = request_with(nodes, 100_KiB);
    const std::size_t smallest = dataflow::smallest_node_memory_bytes(request);
    request.computer.node_memory_bytes = smallest;
    const Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() == smallest);
    CHECK(plan.ray_credits == 1);
    CHECK(plan.ray_batch == 1);
    CHECK(plan.queue_packets == 0);
    CHECK(plan.notes.size() == (nodes == 1 ? 2 : 3));
    request.computer.node_memory_bytes = smallest - 1;
    CHECK(error_of(request).find("node_memory_bytes=" + nodes::size_text(smallest)) != std::string::npos);
  }
}

TEST_CASE("scarce memory costs queued packets first, then credits, then the length of packets, and no more than it must") {
  PlanRequest request = request_with(16, 100_KiB);
  const std::size_t all = make_plan(request).node_memory_max_bytes();
  std::uint32_t queue = 512, credits = 4, batch = 17;
  for (std::size_t memory = all; memory >= dataflow::smallest_node_memory_bytes(request); memory -= 8_KiB) {
    request.computer.node_memory_bytes = memory;
    const Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= memory);
    CHECK(plan.ray_credits <= credits);
    CHECK(plan.ray_batch <= batch);
    CHECK(plan.queue_packets <= queue);
    CHECK((plan.ray_batch == 17 || plan.ray_credits == 1));
    CHECK((plan.ray_credits == 4 || plan.queue_packets == 0));
    queue = plan.queue_packets;
    credits = plan.ray_credits;
    batch = plan.ray_batch;
  }
}

TEST_CASE("what was asked for is not reduced") {
  PlanRequest request = request_with(4, 100_KiB);
  request.rays.ray_batch = 10;
  request.rays.ray_credits = 8;
  request.rays.queue_packets = 100;
  const std::size_t needed = make_plan(request).node_memory_max_bytes();
  CHECK(dataflow::smallest_node_memory_bytes(request) == needed);
  request.computer.node_memory_bytes = needed - 1;
  CHECK_FALSE(error_of(request).empty());
}

TEST_CASE("a memory that is too small names the node that needs most, what it needs, and the node count that works") {
  PlanRequest request = request_with(3, 100_KiB);
  request.shares[1].part_bytes = 2_MiB;
  request.computer.node_memory_bytes = 1_MiB;
  const std::string error = error_of(request, [] { return std::optional<std::uint32_t>(12); });
  INFO(error);
  CHECK(error.find("node 1 needs") != std::string::npos);
  CHECK(error.find(std::to_string(dataflow::smallest_node_memory_bytes(request))) != std::string::npos);
  CHECK(error.find("2097152") != std::string::npos);
  CHECK(error.find("node_count=12") != std::string::npos);
  CHECK(error_of(request, [] { return std::optional<std::uint32_t>(); }).find("with this memory --nodes") == std::string::npos);
}

TEST_CASE("values out of range are wrong usage") {
  const auto check_wrong = [](const PlanRequest& request) { CHECK_THROWS_AS(make_plan(request), core::UsageError); };
  check_wrong(request_with(0, 1));
  check_wrong(request_with(nodes::node_count_max + 1, 1));
  PlanRequest request = request_with(2, 1);
  request.rays.ray_batch = 0;
  check_wrong(request);
  request.rays.ray_batch = dataflow::ray_batch_max + 1;
  check_wrong(request);
  request.rays.ray_batch = dataflow::ray_batch_max;
  CHECK(make_plan(request).ray_batch == dataflow::ray_batch_max);
  CHECK(dataflow::ray_packet_bytes(dataflow::ray_batch_max) <= 64_KiB);
  request.rays.ray_credits = dataflow::ray_credits_max + 1;
  check_wrong(request);
  request.rays.ray_credits = dataflow::ray_credits_max;
  request.rays.queue_packets = dataflow::queue_packets_max + 1;
  check_wrong(request);
  request.rays.queue_packets.reset();
  request.rays.ray_slots = 1;
  CHECK_THROWS_WITH_AS(make_plan(request), doctest::Contains("not both"), core::UsageError);
  request.rays.ray_credits.reset();
  CHECK(error_of(request).empty());
  for (const std::uint32_t slots : {0U, dataflow::ray_slots_max + 1}) {
    request.rays.ray_slots = slots;
    check_wrong(request);
  }
}

TEST_CASE("among more than 128 nodes senders share 64 places, unless credits of their own are asked for, and share if asked to") {
  const Plan few = make_plan(request_with(128, 1000)), many = make_plan(request_with(129, 1000));
  CHECK(few.ray_credits == 4);
  CHECK(few.ray_slots == 0);
  CHECK(many.ray_credits == 0);
  CHECK(many.ray_slots == 64);
  CHECK(many.queue_packets == 128);
  CHECK(many.host_credits == 1);
  PlanRequest request = request_with(129, 1000);
  request.rays.ray_credits = 2;
  CHECK(make_plan(request).ray_credits == 2);
  CHECK(make_plan(request).ray_slots == 0);
  request = request_with(3, 1000);
  request.rays.ray_slots = 5;
  CHECK(make_plan(request).ray_credits == 0);
  CHECK(make_plan(request).ray_slots == 5);
}

TEST_CASE("queues and mailbox of one of 1,024 modelled nodes take 0.5 MB at most, not 3.8 as with a credit a pair") {
  PlanRequest request = request_with(1024, 1000);
  const auto bytes = [&] {
    const nodes::MemoryPlan plan = make_plan(request).node_memory(0);
    return plan[nodes::Category::queues] + plan[nodes::Category::mailbox];
  };
  request.computer.machine.emplace();
  CHECK(bytes() <= 500'000);
  request.rays.ray_credits = 1;
  request.rays.queue_packets = 512;
  CHECK(bytes() > 3'800'000);
}

TEST_CASE("where places are shared each further node takes 142 bytes of every other") {
  const auto bytes = [](std::uint32_t nodes) { return make_plan(request_with(nodes, 1000)).node_memory(0).total(); };
  // A request's slot and its link, credits, a place in the ring of those who ask, and what is known of an owner.
  CHECK((bytes(4096) - bytes(1024)) / (4096 - 1024) == 64 + 4 + 8 + 2 + 64);
}

TEST_CASE("shared places are given up after queued packets and before the length of packets") {
  PlanRequest request = request_with(200, 100_KiB);
  const std::size_t smallest = dataflow::smallest_node_memory_bytes(request);
  for (std::size_t memory = make_plan(request).node_memory_max_bytes(); memory >= smallest; memory -= 16_KiB) {
    request.computer.node_memory_bytes = memory;
    const Plan plan = make_plan(request);
    CHECK(plan.node_memory_max_bytes() <= memory);
    CHECK((plan.ray_slots == 64 || plan.queue_packets == 0));
    CHECK((plan.ray_batch == 17 || plan.ray_slots == 1));
  }
  request.computer.node_memory_bytes = smallest;
  CHECK(make_plan(request).ray_slots == 1);
  request.computer.node_memory_bytes = smallest - 1;
  CHECK_FALSE(error_of(request).empty());
}

TEST_CASE("one node, or nodes without credits, need no queue") {
  CHECK(make_plan(request_with(1, 1000)).queue_packets == 0);
  PlanRequest request = request_with(4, 1000);
  request.rays.ray_credits = 0;
  CHECK(make_plan(request).queue_packets == 0);
}

TEST_CASE("film credits are many where nodes are few, but for a modelled machine") {
  PlanRequest request = request_with(2, 1000);
  CHECK(make_plan(request).film_credits == 128);
  request.computer.machine = nodes::Machine();
  CHECK(make_plan(request).film_credits == 2);
}

TEST_CASE("chaos leaves at least one credit and the mailboxes as they were") {
  PlanRequest request = request_with(4, 1000);
  const Plan calm = make_plan(request);
  std::uint32_t fewest = 99;
  for (std::uint64_t seed = 1; seed < 30; ++seed) {
    request.computer.chaos = nodes::chaos_of(seed);
    const Plan plan = make_plan(request);
    CHECK(plan.ray_credits >= 1);
    CHECK(plan.host_credits >= 1);
    CHECK(plan.film_credits >= 1);
    CHECK(plan.node_mailbox.bulk_slots == calm.node_mailbox.bulk_slots);
    CHECK(plan.host_mailbox.small_slots == calm.host_mailbox.small_slots);
    CHECK(plan.held_bytes > 0);
    fewest = std::min(fewest, plan.ray_credits);
  }
  CHECK(fewest == 1);
}

TEST_CASE("each node is given its own share and no more") {
  PlanRequest request = request_with(3, 1000);
  request.shares[2] = {64000, 500};
  const Plan plan = make_plan(request);
  CHECK(plan.largest_node() == 2);
  const nodes::MemoryPlan small = plan.node_memory(0), large = plan.node_memory(2);
  CHECK(large[core::MemoryUse::home_pages] - small[core::MemoryUse::home_pages] == 62976);  // whole cache lines
  CHECK(large[nodes::Category::mailbox] == small[nodes::Category::mailbox]);
}

}  // namespace dataflow_plan_test
