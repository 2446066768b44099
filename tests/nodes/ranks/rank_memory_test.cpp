#include "nodes/ranks/rank_memory.h"

#include <doctest/doctest.h>

#include <cstdint>

#include "tests/nodes/toy_machine.h"
#include "tests/support/loopback_ranks.h"

namespace dmpc::tests::rank_memory_test {
namespace {

using namespace nodes;

/// A strategy's, as far as memory is concerned: node i has 1000 + i bytes, the host 50.
struct ToyPlan {
  struct {
    ComputerRequest computer;
  } request;
  MailboxCapacity node_mailbox{.small_slots = 10, .bulk_slots = 3, .bulk_payload_bytes = 500};
  MailboxCapacity host_mailbox{.small_slots = 100, .bulk_slots = 1, .bulk_payload_bytes = 2000};

  static MemoryPlan node_memory(std::uint32_t index) { return of(1000 + index); }
  static MemoryPlan host_memory() { return of(50); }
  static MemoryPlan of(std::size_t bytes) {
    MemoryPlan plan;
    plan[Category::queues] = bytes;
    return plan;
  }
};

ToyPlan plan_of(std::uint32_t node_count) { return {.request = {{.node_count = node_count}}}; }

}  // namespace

TEST_CASE("one process alone has all nodes and the host, and no network") {
  const RankMemory memory = rank_memory(peers_of(plan_of(3)), nullptr, 0);
  CHECK(memory.node_count == 3);
  CHECK(memory.has_host);
  CHECK(memory.nodes_bytes == 3 * 1000 + 0 + 1 + 2 + 50);
  CHECK(memory.network.total() == 0);
  CHECK(memory.total() == memory.nodes_bytes);
}

TEST_CASE("each rank has the memories of its own nodes, and together they have all") {
  Loopback loopback(3);
  const RankLinks links(loopback.rank(0));
  const ToyPlan plan = plan_of(5);  // nodes 0 and 1, 2 and 3, 4
  const RankMemory first = rank_memory(peers_of(plan), &links, 0), second = rank_memory(peers_of(plan), &links, 1),
                   third = rank_memory(peers_of(plan), &links, 2);
  CHECK(first.nodes_bytes == 1000 + 1001 + 50);
  CHECK(second.nodes_bytes == 1002 + 1003);
  CHECK(third.nodes_bytes == 1004);
  CHECK(first.node_count == 2);
  CHECK(second.node_count == 2);
  CHECK(third.node_count == 1);
  CHECK(first.has_host);
  CHECK_FALSE(second.has_host);
  CHECK_FALSE(third.has_host);
}

TEST_CASE("an outbox has the places of all mailboxes elsewhere, each large enough for the longest packet and its target") {
  Loopback loopback(3);
  const RankLinks links(loopback.rank(0));
  const auto outbox_bytes = [&](std::uint32_t rank) {
    return rank_memory(peers_of(plan_of(5)), &links, rank).network.outbox_bytes;
  };
  const auto bytes_of_places = [](std::uint32_t small, std::uint32_t bulk, std::size_t bulk_bytes) {
    return MailboxCapacity{small, bulk, bulk_bytes + sizeof(TargetIndex), sizeof(TargetIndex)}.bytes();
  };
  CHECK(outbox_bytes(0) == bytes_of_places(3 * 10, 3 * 3, 500));
  CHECK(outbox_bytes(1) == bytes_of_places(3 * 10 + 100, 3 * 3 + 1, 2000));
  CHECK(outbox_bytes(2) == bytes_of_places(4 * 10 + 100, 4 * 3 + 1, 2000));
}

TEST_CASE("frames and the stream before the run are a rank's, too, but rank 0 is sent no stream") {
  Loopback loopback(3, {}, 20'000);
  const RankLinks links(loopback.rank(0));
  const NetworkMemory first = rank_memory(peers_of(plan_of(5)), &links, 0).network,
                      second = rank_memory(peers_of(plan_of(5)), &links, 1).network;
  CHECK(first.sent_bytes == 2 * 2 * 20'000);
  CHECK(first.arrived_bytes == loopback.rank(0).arrival_bytes());
  CHECK(first.stream_bytes == 0);
  CHECK(second.stream_bytes == stream_window_bytes);
  CHECK(second.total() == second.outbox_bytes + second.sent_bytes + second.stream_bytes);
}

}  // namespace dmpc::tests::rank_memory_test
