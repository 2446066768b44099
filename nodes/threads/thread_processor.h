// One node of those whose programs run on threads: its memory, mailbox, program, and state of the run.
#pragma once

#include <sched.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/base/expect.h"
#include "nodes/atomics.h"
#include "nodes/batching.h"
#include "nodes/chaos.h"
#include "nodes/local_memory.h"
#include "nodes/mailbox.h"
#include "nodes/node.h"
#include "nodes/observer.h"
#include "nodes/runner.h"
#include "nodes/threads/clock.h"
#include "nodes/threads/delayed_packets.h"
#include "nodes/threads/poll_backoff.h"
#include "nodes/threads/thread.h"

namespace dmpc::nodes {

/// The number of quanta after which a node that pauses, or only waits for delayed packets to fall due, gives its core to others.
/// Giving it away in each would cost a time slice each if other processes want the core.
inline constexpr std::uint32_t quanta_per_yield = 16;

/// The queue for packets that chaos delays at this node, if it does.
inline std::optional<DelayedPackets> delayed_packets_of(const std::optional<Chaos>& chaos, const NodeSpecification& specification,
                                                        NodeId id, LocalMemory& memory, Network& network) {
  if (!chaos || specification.held_bytes == 0) {
    return std::nullopt;
  }
  return DelayedPackets(*chaos, id, memory, specification.held_bytes, network);
}

/// What all processors of a computer have in common.
struct ThreadComputer {
  std::uint32_t peer_count;
  Network& network;
  const std::optional<Chaos>& chaos;
  Observer* observer;
  const std::uint64_t& start_ns;  ///< start of the run
  Immutable immutable;
  std::size_t core_count;  ///< 0: not known
};

/// Between a program and the network, with chaos or not: reports to an observer what is sent, when the program sends it.
class Telling final : public Network {
 public:
  /// `call` is the number of the program's. All outlive this.
  Telling(const ThreadComputer& computer, const std::uint64_t& call, Network& next)
      : observer_(computer.observer), start_ns_(&computer.start_ns), immutable_(computer.immutable), call_(&call), next_(&next) {}

  void deliver(NodeId target, const PacketHeader& header, std::span<const std::byte> payload) override {
    tell(target, header, payload, 0);
    next_->deliver(target, header, payload);
  }
  bool deliver_in_place(NodeId target, const PacketHeader& header, std::span<const std::byte> front,
                        std::span<const std::byte> immutable) override {
    if (immutable_ == Immutable::is_copied) {
      return false;
    }
    tell(target, header, front, immutable.size());
    return next_->deliver_in_place(target, header, front, immutable);
  }

 private:
  void tell(NodeId target, const PacketHeader& header, std::span<const std::byte> payload, std::size_t immutable_bytes) const {
    const std::uint64_t now_ns = nanoseconds(CLOCK_MONOTONIC) - *start_ns_;
    observer_->sent({.node = NodeId{header.source},
                     .peer = target,
                     .kind = header.kind,
                     .call = *call_,
                     .payload = payload,
                     .times = {.sending_ns = now_ns, .left_ns = now_ns},
                     .immutable_bytes = immutable_bytes});
  }

  Observer* observer_;
  const std::uint64_t* start_ns_;
  Immutable immutable_;
  const std::uint64_t* call_;
  Network* next_;
};

/// One node with all that belongs to it. On its own cache lines, so that neighbours do not disturb each other's counters.
struct alignas(cache_line_bytes) ThreadProcessor {
  ThreadProcessor(const NodeSpecification& specification, NodeId id, const ThreadComputer& computer)
      : memory(specification.plan, computer.immutable),
        mailbox(specification.mailbox, memory),
        held(delayed_packets_of(computer.chaos, specification, id, memory, computer.network)),
        batching(specification.batching),
        polls(polls_before_sleep(computer.peer_count, computer.core_count), computer.core_count),
        node(id, computer.peer_count, memory, way_out(computer)),
        interrupt_kinds(specification.interrupt_kinds) {
    core::expect(specification.plan[Category::reserve] >= thread_stack_bytes_min, "a plan reserves room for the thread's stack");
    if (computer.chaos) {
      pauses.emplace(*computer.chaos, id);
    }
    program = specification.make_program(node);
    core::expect(program != nullptr, "a specification makes a program");
    memory.seal();
  }

  /// The first network on the way of the program's packets.
  Network& way_out(const ThreadComputer& computer) {
    Network& next = held ? *held : computer.network;
    return computer.observer == nullptr ? next : telling.emplace(computer, call, next);
  }

  /// Whether this node, being slow, skips the next quantum.
  bool sits_out() {
    if (!pauses) {
      return false;
    }
    if (quanta_to_run == 0) {
      quanta_to_run = pauses->next_quanta() + 1;
    }
    --quanta_to_run;
    node.counters().sat_out += quanta_to_run > 0 ? 1 : 0;
    return quanta_to_run > 0;
  }

  /// To be called before another run, which is counted from zero.
  void begin_again() {
    node.counters() = {};
    held_before = held ? held->count() : 0;
  }

  /// Passes on the packets whose time has come; returns whether others are still delayed.
  bool holds_packets() {
    if (!held) {
      return false;
    }
    held->pass_quantum();
    node.counters().held = held->count() - held_before;
    return !held->empty();
  }

  /// A quantum in which only chaos keeps the node from sleeping.
  void pass_idly() {
    if (++quanta_idle % quanta_per_yield == 0) {
      sched_yield();
    }
  }

  LocalMemory memory;
  Mailbox mailbox;
  std::optional<DelayedPackets> held;
  Batching batching;
  Mailbox::Batch waiting;  ///< packets sent that may wait, in slots of their target
  NodeId waiting_for{};    ///< their target
  std::uint32_t waiting_count = 0, quanta_waited = 0;
  PollBackoff polls;               ///< at its mailbox before it sleeps
  std::optional<Telling> telling;  ///< if there is an observer
  Node node;
  std::unique_ptr<Program> program;
  std::optional<ChaosPauses> pauses;
  std::uint64_t held_before = 0;  ///< packets delayed in earlier runs
  std::uint32_t quanta_idle = 0;
  std::uint64_t call = 0;                                 ///< number of the program's call, if there is an observer
  Charges charged;                                        ///< until the last one's end, likewise
  std::uint32_t interrupt_kinds;                          ///< which do not end a wait
  bool is_waiting = false;                                ///< it has nothing to do, if there is an observer
  std::uint64_t waits_since_ns = 0, service_idle_ns = 0;  ///< likewise; what it did for others meanwhile
  std::uint32_t quanta_to_run = 0;                        ///< the node runs again after this number of quanta
  bool is_asleep = false;                                 ///< on a worker thread: its mailbox's word was made ASLEEP
  std::uint64_t asleep_since_ns = 0;
  Thread thread;  ///< unless on a worker thread
};

}  // namespace dmpc::nodes
