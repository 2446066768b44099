#include "apps/lab/bench/speed/busy_processes.h"

#include <algorithm>
#include <iterator>

namespace dmpc::apps {

BusyProcesses::BusyProcesses(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    processes_.emplace_back(ChildSettings{.program = "sh", .arguments = {"-c", "while :; do :; done"}, .gets_ctrl_c = false});
  }
}

std::vector<pid_t> BusyProcesses::ids() const {
  std::vector<pid_t> ids;
  std::transform(processes_.begin(), processes_.end(), std::back_inserter(ids),
                 [](const ChildProcess& process) { return process.id(); });
  return ids;
}

}  // namespace dmpc::apps
