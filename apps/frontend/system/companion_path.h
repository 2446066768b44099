// Finds dmpc's auxiliary programs and modules.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

/// A part of dmpc is missing or belongs to another build: this is no bug, but dmpc cannot continue. The message names the part
/// and the remedy.
struct InstallationError : core::InternalError {
  using core::InternalError::InternalError;
};

enum class CompanionOf : std::uint8_t {
  dmpc,        ///< beside dmpc in a build, or in a folder beside its own if installed
  own_program  ///< only in absolute folders of the run path: for a user's own program, which may lie anywhere
};

/// Finds the file in one of these folders, as an absolute path without links; the environment is ignored. For `dmpc` these are
/// the folder of the running program and `installed`, relative to it; for both, and for a program in a folder `tests`, the `apps`
/// beside that folder, as in builds. Files that users other than dmpc's own may have written (trusted_path.h) are skipped. If no
/// file is found, it throws an InstallationError that names `what` ("the program x, which reads foreign files for dmpc,"), the
/// folders, and the untrusted files.
std::filesystem::path companion_path(const std::string& name, const std::string& installed, const std::string& what,
                                     CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
