// What a run asks of the computer, whatever program it is for: options, runs and plans have it as a member.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "nodes/chaos.h"
#include "nodes/machine.h"

namespace dmpc::nodes {

class RankLinks;

/// A value; what is out of range is refused by the plan that is made from it.
struct ComputerRequest {
  std::uint32_t node_count = 8;
  /// The bound of each node's local memory. Without it a plan takes what it needs.
  std::optional<std::size_t> node_memory_bytes = std::nullopt;
  std::size_t stack_reserve_bytes = std::size_t{256} << 10U;  ///< of each node's thread
  /// Disturbs the run; its result stays the same. Plans have fewer credits, and room for packets held back; mailboxes stay as
  /// they are.
  std::optional<Chaos> chaos = std::nullopt;
  /// So many threads of a process, at least 1 and no more than there are nodes, drive all of its nodes in turn. Without it each
  /// node has a thread of its own. Plans are the same, stacks included. Not with a machine.
  std::optional<std::uint32_t> pool_threads = std::nullopt;
  /// A modelled machine, in virtual time, in place of threads. Not with chaos.
  std::optional<Machine> machine = std::nullopt;

  /// The ranks on which the nodes are (nodes/ranks/ranks_runner.h), in place of this process alone; outlive the run, which each
  /// of them calls with equal arguments. Not with a machine.
  RankLinks* ranks = nullptr;

  /// The machine, or nothing where nodes are threads. Lives as long as this does.
  const Machine* model() const { return machine ? &*machine : nullptr; }
};

}  // namespace dmpc::nodes
