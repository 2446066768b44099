#include "apps/lab/bench/speed/timed_process.h"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <sstream>

#include "apps/edge/system/child_process.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr useconds_t pause_microseconds = 1000;

double seconds_of(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

/// Asks it to end, and gives it time to end what it has started. What does not is killed with its ChildProcess.
void end_gently(ChildProcess& process) {
  constexpr int pauses_max = 2000;
  ::kill(process.id(), SIGTERM);
  for (int pause = 0; pause < pauses_max && !process.status(); ++pause) {
    ::usleep(pause_microseconds);
  }
}

/// Of all children that have been waited for.
double children_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

}  // namespace

TimedProcess time_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          const Interrupt& interrupt, const std::filesystem::path& folder) {
  // The program may be called by a name that means another one to its child, as /proc/self/exe is.
  std::error_code unknown;
  const std::filesystem::path found = std::filesystem::canonical(program, unknown);
  const double before = children_seconds();
  Stopwatch stopwatch;
  ChildProcess process({.program = (program.has_parent_path() && !unknown ? found : program).string(),
                        .arguments = arguments,
                        .folder = folder,
                        .gets_ctrl_c = false});
  std::optional<int> status;
  while (!(status = process.status())) {
    if (interrupt.requested()) {
      end_gently(process);
    }
    interrupt.check();
    ::usleep(pause_microseconds);
  }
  const TimedProcess timed{{stopwatch.lap(), children_seconds() - before}, process.errors()};
  if (*status != 0) {
    throw core::InputError(program.string() + " was to be timed and ended with status " + std::to_string(*status) +
                           (timed.complaint.empty() ? "" : ", saying: " + timed.complaint));
  }
  return timed;
}

std::optional<std::filesystem::path> program_on_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code unknown;
    if (std::filesystem::is_regular_file(program, unknown) && ::access(program.c_str(), X_OK) == 0) {
      return program;
    }
  }
  return std::nullopt;
}

}  // namespace dmpc::apps
