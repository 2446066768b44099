// Which of a driver's nodes are awake: its real code in all its interleavings, and deliberate errors that this search must find.
#include "nodes/threads/awake_nodes.h"

#include <doctest/doctest.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/mailbox.h"
#include "tests/nodes/explored_atomics.h"

namespace dmpc::tests::awake_nodes_test {
namespace {

using nodes::LocalMemory;
using nodes::MailboxCapacity;
using nodes::Packet;
using nodes::PacketHeader;
using Mailbox = nodes::BasicMailbox<ExploredAtomics>;
using AwakeCount = nodes::BasicAwakeCount<ExploredAtomics>;
using AwakeNodes = nodes::BasicAwakeNodes<ExploredAtomics>;
template <class T>
using Atomic = ExploredAtomics::Atomic<T>;

constexpr MailboxCapacity capacity{.small_slots = 1};

void check(bool condition, const char* sentence) { Explorer::current().check(condition, sentence); }

nodes::MemoryPlan plan_of(std::size_t bytes) {
  nodes::MemoryPlan plan;
  plan[nodes::Category::mailbox] = bytes;
  return plan;
}

/// Three nodes in a ring, the first two of one driver, the last of another: a token makes its way, and nodes and drivers sleep
/// when they have nothing to do, as the runner does it. The last driver awake must be the last one, see everyone's state and end
/// the run.
struct PoolRing {
  static constexpr std::size_t thread_count = 2;
  static constexpr std::uint32_t node_count = 3, hops = 4;
  static constexpr std::array<std::uint32_t, 3> first_of{0, 2, 3};  ///< node of each driver, and behind the last

  PoolRing() {
    ExploredAtomics::forget_cells();
    for (std::size_t worker_thread = 0; worker_thread < thread_count; ++worker_thread) {
      for (std::uint32_t node = first_of[worker_thread]; node < first_of[worker_thread + 1]; ++node) {
        mailboxes[node].set_wake_up(worker_threads[worker_thread].wake_up(node - first_of[worker_thread]));
      }
    }
  }

  void thread(std::size_t worker_thread) {
    AwakeNodes& own = worker_threads[worker_thread];
    if (worker_thread == 0) {
      pass(0, hops);
    }
    while (true) {
      own.take_woken([](std::uint32_t /*number*/) {});
      if (const std::optional<std::uint32_t> number = own.next()) {
        take_turn(own, *number, first_of[worker_thread] + *number);
      } else if (own.woken().fall_asleep()) {
        if (ended.load(std::memory_order_relaxed) != 0) {
          return;
        }
        awake.leave() ? end() : own.woken().wait();
      }
    }
  }

  void take_turn(AwakeNodes& own, std::uint32_t number, std::uint32_t node) {
    mailboxes[node].drain([this, node](const Packet& packet) { arrive(node, packet.as<std::uint32_t>()); });
    if (!mailboxes[node].fall_asleep()) {
      own.stay(number);
    }
  }

  void arrive(std::uint32_t node, std::uint32_t left) {
    ExploredAtomics::writes(&arrivals[node]);
    ++arrivals[node];
    if (left > 0) {
      pass(node, left);
    }
  }

  void pass(std::uint32_t node, std::uint32_t left) {
    const std::uint32_t sent = left - 1;
    const PacketHeader header{.bytes = sizeof(sent), .source = static_cast<std::uint16_t>(node), .kind = 0};
    check(mailboxes[(node + 1) % node_count].push(header, std::as_bytes(std::span(&sent, 1)), awake), "a token has room");
  }

  void end() {
    std::uint32_t sum = 0;
    for (const std::uint32_t& count : arrivals) {
      ExploredAtomics::reads(&count);
      sum += count;
    }
    check(sum == hops, "no driver is awake only when nothing is under way");
    ended.store(1, std::memory_order_relaxed);
    for (AwakeNodes& worker_thread : worker_threads) {
      worker_thread.woken().rouse();
    }
  }

  void finish() { check(ended.load(std::memory_order_relaxed) == 1, "the end is found"); }

  LocalMemory memory{plan_of(node_count * Mailbox::bytes(capacity) + AwakeNodes::bytes(2) + AwakeNodes::bytes(1))};
  AwakeCount awake{thread_count};
  std::array<Mailbox, node_count> mailboxes{Mailbox(capacity, memory), Mailbox(capacity, memory), Mailbox(capacity, memory)};
  std::array<AwakeNodes, thread_count> worker_threads{AwakeNodes(2, memory, awake), AwakeNodes(1, memory, awake)};
  Atomic<std::uint32_t> ended{0};
  std::array<std::uint32_t, node_count> arrivals{};
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int preemptions_max = 1;
constexpr std::uint64_t executions_max = 5'000;
#else
constexpr int preemptions_max = 3;
constexpr std::uint64_t executions_max = 400'000;
#endif

std::string failure_of(const Mutation& mutation) {
  std::string failure;
  for (const auto& [preemptions, stale_loads] : {std::pair{1, 0}, std::pair{1, 1}, std::pair{2, 0}}) {
    if (failure.empty()) {
      failure = Explorer({.preemptions_max = preemptions, .stale_loads_max = stale_loads, .mutation = mutation})
                    .explore<PoolRing>()
                    .failure;
    }
  }
  return failure;
}

TEST_CASE("the last driver awake is the last in every interleaving with few preemptions" * doctest::test_suite("slow")) {
  const Exploration result = Explorer({.preemptions_max = preemptions_max}).explore<PoolRing>();
  CHECK(result.failure == "");
  CHECK(result.is_complete);
}

TEST_CASE("drivers and their nodes are right when any one load returns an old value") {
  const Exploration result =
      Explorer({.preemptions_max = 1, .stale_loads_max = 1, .executions_max = executions_max}).explore<PoolRing>();
  CHECK(result.failure == "");
}

TEST_CASE("a driver that is not woken, or counted too late, is found out, and a node that sleeps without a look") {
  CHECK(failure_of({.kind = Mutation::Kind::no_wake}) != "");
  CHECK(failure_of({.kind = Mutation::Kind::late_raise}) != "");
  CHECK(failure_of({.kind = Mutation::Kind::blind_compare}) != "");
}

TEST_CASE("a driver's nodes have their turns one after the other, and who is woken comes last") {
  LocalMemory memory(plan_of(nodes::AwakeNodes::bytes(3)));
  nodes::AwakeCount awake(1);
  nodes::AwakeNodes nodes(3, memory, awake);
  CHECK(nodes.next() == 0);
  CHECK(nodes.next() == 1);
  nodes.stay(0);
  nodes.wake_up(1).ring();
  std::vector<std::uint32_t> woken;
  nodes.take_woken([&woken](std::uint32_t number) { woken.push_back(number); });
  CHECK(woken == std::vector<std::uint32_t>{1});
  CHECK(nodes.next() == 2);
  CHECK(nodes.next() == 0);
  CHECK(nodes.next() == 1);
  CHECK_FALSE(nodes.next());
}

}  // namespace
}  // namespace dmpc::tests::awake_nodes_test
