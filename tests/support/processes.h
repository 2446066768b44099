// Processes of this computer, told by a part of their command lines.
#pragma once

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Processes whose command line, without separators, contains `part`; without those that have ended and are not waited for.
inline std::vector<pid_t> processes_with(const std::string& part) {
  std::vector<pid_t> found;
  std::error_code ended;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ended)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos &&
        file_text(entry.path() / "cmdline").find(part) != std::string::npos) {
      found.push_back(std::stoi(name));
    }
  }
  return found;
}

/// Waits until `holds()`; false after a minute without.
template <class Holds>
bool comes_to(const Holds& holds) {
  for (int attempt = 0; attempt < 6000; ++attempt) {
    if (holds()) {
      return true;
    }
    ::usleep(10'000);
  }
  return false;
}

}  // namespace dmpc::tests
