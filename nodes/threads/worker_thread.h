// A thread that runs several nodes in turn: its share of a computer's, or of a rank's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "nodes/atomics.h"
#include "nodes/awake_count.h"
#include "nodes/local_memory.h"
#include "nodes/threads/awake_nodes.h"
#include "nodes/threads/clock.h"
#include "nodes/threads/thread.h"
#include "nodes/threads/thread_processor.h"
#include "nodes/threads/turn_times.h"

namespace dmpc::nodes {

/// The maximum number of quanta in a node's turn.
inline constexpr int quanta_per_turn = 64;

/// Its nodes, `share`, which belong to no other worker thread, the order of their turns, and their times. Thread safety: as
/// AwakeNodes; made before the threads start.
struct alignas(cache_line_bytes) WorkerThread {
  /// Gives the nodes' mailboxes their wake-ups. `awake` counts the worker thread. Both outlive this.
  WorkerThread(std::span<const std::unique_ptr<ThreadProcessor>> share, AwakeCount& awake)
      : nodes(share), memory(plan(share.size())), awake_nodes(static_cast<std::uint32_t>(share.size()), memory, awake) {
    for (std::uint32_t number = 0; number < share.size(); ++number) {
      share[number]->mailbox.set_wake_up(awake_nodes.wake_up(number));
    }
  }

  /// The stack size, enough for each of its nodes in turn.
  std::size_t stack_bytes() const {
    std::size_t most = 0;
    for (const auto& node : nodes) {
      most = std::max(most, node->memory.plan()[Category::reserve]);
    }
    return most;
  }

  /// To be called before another run: all nodes, which sleep, are awake and in line by number. Before the thread starts.
  void begin_again() {
    for (const auto& node : nodes) {
      node->mailbox.rouse();
    }
    awake_nodes.take_woken([this](std::uint32_t number) { nodes[number]->is_asleep = false; });
  }
  /// Begins or goes on after a sleep.
  void begin_turns() { times.begin(nanoseconds(CLOCK_MONOTONIC), nanoseconds(CLOCK_THREAD_CPUTIME_ID)); }
  /// A turn of this node is over.
  void end_turn(ThreadProcessor& self) {
    if (times.end_turn(self.node.counters(), nanoseconds(CLOCK_MONOTONIC))) {
      share_out_time();
    }
    self.asleep_since_ns = times.now_ns();
  }
  void share_out_time() { times.share_out(nanoseconds(CLOCK_THREAD_CPUTIME_ID)); }
  /// Ends the run, which began at `start_ns` for this worker thread.
  void end_turns(std::uint64_t start_ns) {
    share_out_time();
    const std::uint64_t end_ns = nanoseconds(CLOCK_MONOTONIC);
    for (const auto& node : nodes) {
      node->node.counters().asleep_ns += node->is_asleep ? end_ns - node->asleep_since_ns : 0;
      node->node.counters().wall_ns = end_ns - start_ns;
    }
  }

  /// Accounts the sleep of a node that has been put in line.
  void note_sleep(ThreadProcessor& self) const {
    self.node.counters().asleep_ns += times.now_ns() - self.asleep_since_ns;
    self.is_asleep = false;
  }

  std::span<const std::unique_ptr<ThreadProcessor>> nodes;
  LocalMemory memory;  ///< no node's: for the numbers of nodes that are woken
  AwakeNodes awake_nodes;
  TurnTimes times;
  Thread thread;

 private:
  static MemoryPlan plan(std::size_t count) {
    MemoryPlan plan;
    plan[Category::mailbox] = AwakeNodes::bytes(static_cast<std::uint32_t>(count));
    return plan;
  }
};

}  // namespace dmpc::nodes
