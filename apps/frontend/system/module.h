// Parts of dmpc with foreign libraries that are slow to load: shared modules, opened when they are first wanted.
#pragma once

#include <cstdint>
#include <string>

#include "apps/frontend/system/companion_path.h"

namespace dmpc::apps {

/// What a module exports, as the C symbol dmpc_module.
struct Module {
  const char* build;      ///< DMPC_MODULES_BUILD as it was compiled
  const void* interface;  ///< what its header says it is
};

/// Opens a shared library, which is never closed again; nullptr if it cannot be opened. Its libraries may start threads as they
/// are loaded, and change the arithmetic, which then is as usual again. `complaint` becomes
/// what the loader says if it cannot. Thread-safe.
void* open_library(const std::string& path, std::string* complaint = nullptr);
/// What an opened library exports by this name; nullptr if it has none of it. Thread-safe.
void* exported_by(void* library, const char* name);

/// The interface of apps/modules/NAME.cpp, whose file, found as companion_path() says, is never closed again. `purpose` goes on
/// "the module dmpc_NAME.so, with which dmpc ...". Throws InstallationError if it is missing, cannot be opened or is of another
/// build, ComputerCapacityError if this computer has no room for it. Thread-safe.
const void* open_module(const std::string& name, const std::string& purpose, CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
