#include "apps/frontend/run/runner_kind.h"

#include "nodes/runner.h"

namespace dmpc::apps {

void choose_pool(RunnerKind runner, nodes::ComputerRequest& computer) {
  if (runner == RunnerKind::pool && !computer.pool_threads) {
    computer.pool_threads = nodes::processors_allowed();
  }
}

std::string runner_text(const nodes::ComputerRequest& computer, const std::string& where) {
  if (computer.machine) {
    return "virtual, in the time of a modelled " + computer.machine->name;
  }
  return "threads" + where + (computer.pool_threads ? ", a pool that drives all nodes in turn" : ", one a node") +
         ", by the wall clock";
}

}  // namespace dmpc::apps
