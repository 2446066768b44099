// Programs that tests find by their names.
#pragma once

#include <string>
#include <vector>

#include "tests/support/child_process.h"

namespace dmpc::tests {

struct Said {
  int status = 0;
  std::string output, errors;
};

/// Runs a program to its end; a name without a slash is looked for as shells do. Status 127 if there is none.
inline Said run(const std::vector<std::string>& command) {
  std::vector<std::string> found = {"/usr/bin/env"};
  found.insert(found.end(), command.begin(), command.end());
  ChildProcess process(found);
  const int status = process.status();
  return {status, process.output(), process.errors()};
}

inline bool is_installed(const std::string& program) { return run({"sh", "-c", "command -v " + program}).status == 0; }

}  // namespace dmpc::tests
