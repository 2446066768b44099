#include "apps/frontend/system/completed_process.h"

#include <unistd.h>

#include <optional>
#include <system_error>

#include "apps/frontend/system/child_process.h"

namespace dmpc::apps {

CompletedProcess run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt) {
  constexpr useconds_t pause_microseconds = 1000;
  // The program's name may mean another one to its child, as /proc/self/exe does.
  std::error_code unknown;
  const std::filesystem::path found = std::filesystem::canonical(program, unknown), path = unknown ? program : found;
  ChildProcess process({.program = path.string(), .arguments = arguments, .gets_ctrl_c = false});
  std::optional<int> status;
  while (!(status = process.status())) {
    interrupt.check();
    ::usleep(pause_microseconds);
  }
  return {*status, process.errors()};
}

}  // namespace dmpc::apps
