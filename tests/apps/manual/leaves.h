// The commands without subcommands.
#pragma once

#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"

namespace dmpc::tests {

/// A command with the words that the user types for it.
struct Leaf {
  std::string path;  ///< "study balance"
  const apps::CommandDescription* command = nullptr;
};

/// The commands in `outer` that have no subcommands, in the order of their declaration; `outer` outlives them. `path` is put
/// before each name.
inline std::vector<Leaf> leaves_of(const apps::CommandDescription& outer, const std::string& path = "") {
  std::vector<Leaf> leaves;
  for (const apps::CommandDescription& command : outer.commands) {
    const std::string inner_path = path + command.name;
    const std::vector<Leaf> inner = leaves_of(command, inner_path + " ");
    if (inner.empty()) {
      leaves.push_back({inner_path, &command});
    }
    leaves.insert(leaves.end(), inner.begin(), inner.end());
  }
  return leaves;
}

}  // namespace dmpc::tests
