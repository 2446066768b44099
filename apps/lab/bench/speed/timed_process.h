// A program as a process of its own, which is timed from its start to its end.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/edge/system/stopwatch.h"

namespace dmpc::apps {

struct TimedProcess {
  Times times;            ///< the processor's with that of the processes that it waited for; the wall clock's to a millisecond
  std::string complaint;  ///< what it wrote to stderr
};

/// Runs `program`, which is looked for along PATH unless it has a slash, in `folder` to its end. It does not get the terminal's
/// Ctrl-C. Throws core::InputError if it cannot be started or ends otherwise than with status 0; Interrupted after a signal, when
/// it has been ended. Not thread-safe: meanwhile no other child of this process may end.
TimedProcess time_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          const Interrupt& interrupt, const std::filesystem::path& folder = ".");

/// Where a shell would find a program of this name; nothing if nowhere.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

}  // namespace dmpc::apps
