#include "nodes/runner.h"

#include "core/base/expect.h"
#include "nodes/threads/threads_runner.h"
#include "nodes/virtual/virtual_runner.h"

namespace dmpc::nodes {

std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const RunnerChoice& choice) {
  if (choice.machine) {
    core::expect(!choice.chaos, "chaos disturbs threads only");
    return std::make_unique<VirtualRunner>(specifications, *choice.machine, choice.observer);
  }
  return std::make_unique<ThreadsRunner>(specifications, choice.chaos, choice.observer);
}

}  // namespace dmpc::nodes
