// Settings of the computer for a run of any program; a member of options, runs and plans.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nodes/chaos.h"
#include "nodes/local_memory.h"
#include "nodes/machine.h"

namespace dmpc::nodes {

class RankLinks;

/// A value; values out of range are rejected by the plan that is made from it.
struct ComputerRequest {
  std::uint32_t node_count = 8;
  /// The limit of each node's local memory. Without it a plan takes what it needs.
  std::optional<std::size_t> node_memory_bytes = std::nullopt;
  std::size_t stack_reserve_bytes = std::size_t{256} << 10U;  ///< for each node's thread
  /// Disturbs the run; its result stays the same. Plans have fewer credits, and memory for delayed packets; mailboxes stay as
  /// they are.
  std::optional<Chaos> chaos = std::nullopt;
  /// The number of a process's threads, at least 1 and at most the number of nodes, that run all of its nodes in turn. Without it
  /// each node has a thread of its own. Plans are the same, stacks included. Not with a machine.
  std::optional<std::uint32_t> pool_threads = std::nullopt;
  /// A modelled machine, in virtual time, in place of threads. Not with chaos.
  std::optional<Machine> machine = std::nullopt;

  /// The ranks that share the nodes (nodes/ranks/ranks_runner.h), in place of this process alone; outlive the run, which each of
  /// them starts with equal arguments. Not with a machine.
  RankLinks* ranks = nullptr;

  /// The machine; nullptr if nodes are threads. Valid as long as this.
  const Machine* model() const { return machine ? &*machine : nullptr; }
  /// How nodes store bytes that never change. Those of a modelled machine or a pool, which share the real computer's caches,
  /// refer to them; those with threads of their own, on ranks, and under chaos, which delays bytes, copy them.
  Immutable immutable() const {
    const bool is_plain_pool = pool_threads && !chaos && ranks == nullptr;
    return machine || is_plain_pool ? Immutable::is_referred_to : Immutable::is_copied;
  }
};

}  // namespace dmpc::nodes
