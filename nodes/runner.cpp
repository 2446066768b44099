#include "nodes/runner.h"

#include <sched.h>

#include <algorithm>
#include <thread>

#include "core/base/refusal.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/threads/threads_runner.h"
#include "nodes/virtual/virtual_runner.h"

namespace dmpc::nodes {

MemoryPlan memory_beside_program(const MailboxCapacity& mailbox, std::uint32_t peer_count, std::size_t held_bytes,
                                 std::size_t stack_bytes) {
  MemoryPlan plan = credit_table(peer_count);
  plan[Category::queues] += held_bytes;
  plan[Category::mailbox] = mailbox.bytes();
  plan[Category::reserve] = stack_bytes;
  return plan;
}

std::uint32_t processors_allowed() {
  cpu_set_t allowed;
  return ::sched_getaffinity(0, sizeof(allowed), &allowed) == 0 ? static_cast<std::uint32_t>(CPU_COUNT(&allowed))
                                                                : std::max(std::thread::hardware_concurrency(), 1U);
}

void check_nodes_for(std::uint32_t node_count, std::uint32_t rank_count) {
  core::check_use(node_count >= rank_count, core::field_of<&ComputerRequest::node_count>(), "=", node_count,
                  ": expected at least one node for each of the ", rank_count, " ranks");
}

void check_ranks(const ComputerRequest& computer) {
  check_nodes_for(computer.node_count, computer.ranks == nullptr ? 1 : computer.ranks->rank_count());
}

std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const ComputerRequest& computer,
                                    Observer* observer) {
  if (computer.machine) {
    core::expect(!computer.chaos && computer.ranks == nullptr && !computer.pool_threads,
                 "chaos disturbs threads only, and a model has neither ranks nor a pool");
    return std::make_unique<VirtualRunner>(specifications, *computer.machine, observer);
  }
  if (computer.ranks != nullptr) {
    return std::make_unique<RanksRunner>(specifications, *computer.ranks, computer.chaos, observer, computer.pool_threads);
  }
  return std::make_unique<ThreadsRunner>(specifications, computer.chaos, observer, computer.pool_threads, computer.immutable());
}

}  // namespace dmpc::nodes
