#include "nodes/runner.h"

#include "core/base/expect.h"
#include "nodes/threads/threads_runner.h"
#include "nodes/virtual/virtual_runner.h"

namespace dmpc::nodes {

std::unique_ptr<Runner> make_runner(std::span<const NodeSpecification> specifications, const ComputerRequest& computer,
                                    Observer* observer) {
  if (computer.machine) {
    core::expect(!computer.chaos, "chaos disturbs threads only");
    return std::make_unique<VirtualRunner>(specifications, *computer.machine, observer);
  }
  return std::make_unique<ThreadsRunner>(specifications, computer.chaos, observer);
}

}  // namespace dmpc::nodes
