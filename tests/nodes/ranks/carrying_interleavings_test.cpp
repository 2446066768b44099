// Nodes of a rank that carry their packets themselves, and the communicating thread that sleeps meanwhile, in all interleavings
// that have few preemptions: nothing is left lying when all sleep.
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "nodes/mailbox.h"
#include "tests/nodes/explored_atomics.h"

namespace dmpc::tests::ranks_carrying_interleavings_test {
namespace {

using Mailbox = nodes::BasicMailbox<ExploredAtomics>;
using AwakeCount = nodes::BasicAwakeCount<ExploredAtomics>;
using nodes::MailboxCapacity;

enum class Slip : std::uint8_t { none, polls_before_sleep, calls_before_leaving };

/// Two nodes put a packet each into the outbox, carry if nobody else does, and sleep for good. Thread 0 communicates, and sleeps
/// without a time-out while a node is awake. As RanksRunner and NodeThreads do it.
template <Slip slip>
struct TwoNodes {
  static constexpr std::size_t thread_count = 3;
  static constexpr MailboxCapacity outbox_capacity{.small_slots = 2};

  TwoNodes() { ExploredAtomics::forget_cells(); }

  void thread(std::size_t index) { index == 0 ? communicate() : compute(index); }

  bool try_lock() { return carrying.exchange(1, std::memory_order_acquire) == 0; }
  void unlock() { carrying.store(0, std::memory_order_release); }

  void carry() {
    outbox.drain_while([this](const nodes::Packet& /*packet*/) {
      ExploredAtomics::writes(&carried);
      ++carried;
      return true;
    });
  }

  void compute(std::size_t index) {
    const nodes::PacketHeader header{.bytes = 0, .source = static_cast<std::uint16_t>(index), .kind = 0};
    Explorer::current().check(outbox.push(header, {}, uncounted), "a packet has room");
    if (try_lock()) {
      carry();
      unlock();
    }
    if (slip == Slip::calls_before_leaving) {
      call.rouse();
    }
    if (awake.leave() && slip != Slip::calls_before_leaving) {
      call.rouse();
    }
  }

  /// Where the lock is not free it goes to sleep in place of waiting for it.
  void communicate() {
    while (true) {
      if (try_lock()) {
        carry();
        unlock();
      }
      const bool all_slept = slip == Slip::polls_before_sleep && awake.is_zero();
      Explorer::current().check(call.fall_asleep(), "nothing is put before a communicating thread");
      if (slip == Slip::polls_before_sleep ? all_slept : awake.is_zero()) {
        break;
      }
      call.wait();
    }
    Explorer::current().check(try_lock(), "nodes that sleep carry nothing");
    carry();
    unlock();
  }

  void finish() { Explorer::current().check(carried == 2, "every packet is carried, once"); }

  static nodes::MemoryPlan plan() {
    nodes::MemoryPlan plan;
    plan[nodes::Category::mailbox] = Mailbox::bytes(outbox_capacity) + Mailbox::bytes({});
    return plan;
  }

  nodes::LocalMemory memory{plan()};
  Mailbox outbox{outbox_capacity, memory}, call{{}, memory};
  AwakeCount awake{2}, uncounted{0};
  ExploredAtomics::Atomic<std::uint32_t> carrying{0};
  std::uint32_t carried = 0;
};

template <Slip slip>
std::string failure_of() {
  return Explorer({.preemptions_max = 2, .stale_loads_max = 1}).explore<TwoNodes<slip>>().failure;
}

TEST_CASE("the last node to sleep calls the thread that communicates, and nothing is left lying") {
  CHECK(failure_of<Slip::none>() == "");
}

TEST_CASE("a communicating thread that looks before it announces sleep is found out") {
  CHECK(failure_of<Slip::polls_before_sleep>() != "");
}

TEST_CASE("a node that calls before it leaves is found out") { CHECK(failure_of<Slip::calls_before_leaving>() != ""); }

}  // namespace
}  // namespace dmpc::tests::ranks_carrying_interleavings_test
