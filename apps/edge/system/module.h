// Parts of dmpc with foreign libraries that are slow to load: shared modules, opened when they are first wanted.
#pragma once

#include <cstdint>
#include <string>

#include "apps/edge/system/companion_path.h"

namespace dmpc::apps {

/// What a module exports, as the C symbol dmpc_module.
struct Module {
  const char* build;      ///< DMPC_MODULES_BUILD as it was compiled
  const void* interface;  ///< what its header says it is
};

/// The interface of apps/modules/NAME.cpp, whose file, found as companion_path() says, is never closed again. `purpose` goes on
/// "the module dmpc_NAME.so, with which dmpc ...". Throws InstallationError if it is missing, cannot be opened or is of another
/// build, ComputerRoomError if this computer has no room for it. Thread-safe.
const void* open_module(const std::string& name, const std::string& purpose, CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
