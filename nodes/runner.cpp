#include "nodes/runner.h"

#include <string>

#include "core/base/expect.h"
#include "nodes/ranks/ranks_runner.h"
#include "nodes/threads/threads_runner.h"
#include "nodes/virtual/virtual_runner.h"

namespace dmpc::nodes {

void check_ranks(const ComputerRequest& computer) {
  const std::uint32_t ranks = computer.ranks == nullptr ? 1 : computer.ranks->rank_count();
  if (computer.node_count < ranks) {
    throw core::UsageError("node_count=" + std::to_string(computer.node_count) + ": expected at least one node for each of the " +
                           std::to_string(ranks) + " ranks");
  }
}

std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const ComputerRequest& computer,
                                    Observer* observer) {
  if (computer.machine) {
    core::expect(!computer.chaos && computer.ranks == nullptr, "chaos disturbs threads only, and a model has no ranks");
    return std::make_unique<VirtualRunner>(specifications, *computer.machine, observer);
  }
  if (computer.ranks != nullptr) {
    return std::make_unique<RanksRunner>(specifications, *computer.ranks, computer.chaos, observer);
  }
  return std::make_unique<ThreadsRunner>(specifications, computer.chaos, observer);
}

}  // namespace dmpc::nodes
