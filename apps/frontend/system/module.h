// Shared modules with foreign libraries that are slow to load: opened on first use.
#pragma once

#include <string>

#include "apps/frontend/system/companion_path.h"

namespace dmpc::apps {

/// What a module exports as the C symbol dmpc_module.
struct Module {
  const char* build;      ///< DMPC_MODULES_BUILD at its compilation
  const void* interface;  ///< the type that its header names
};

/// Opens a shared library, which is never closed; returns nullptr if it cannot be opened. The libraries that it loads may start
/// threads and change the floating-point mode, which is restored. `complaint` receives the loader's message on failure.
/// Thread-safe.
void* open_library(const std::string& path, std::string* complaint = nullptr);
/// Returns a library's symbol of this name; nullptr if there is none. Thread-safe.
void* exported_by(void* library, const char* name);

/// Returns the interface of apps/modules/NAME.cpp. The module is found by companion_path() and never closed. `purpose` continues
/// "the module dmpc_NAME.so, with which dmpc ...". Throws InstallationError if it is missing, cannot be opened or is from another
/// build, ComputerCapacityError if resources of this computer are exhausted. Thread-safe.
const void* open_module(const std::string& name, const std::string& purpose, CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
