#include "apps/edge/run/runner_kind.h"

#include "nodes/runner.h"

namespace dmpc::apps {

void choose_pool(RunnerKind runner, nodes::ComputerRequest& computer) {
  if (runner == RunnerKind::pool && !computer.pool_threads) {
    computer.pool_threads = nodes::processors_allowed();
  }
}

}  // namespace dmpc::apps
