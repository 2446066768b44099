// Runs a program as a child process to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

struct CompletedProcess {
  int status = 0;         ///< its exit status; below 0: the signal that ended it
  std::string complaint;  ///< its output to stderr
};

/// Runs `program` with `arguments` and without input to its end. It does not get the terminal's Ctrl-C. Throws core::InputError
/// if it cannot be started, and Interrupted after a signal, once the program has ended, too.
CompletedProcess run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             const Interrupt& interrupt);

}  // namespace dmpc::apps
