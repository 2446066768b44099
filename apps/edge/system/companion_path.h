// Where the programs and modules lie that belong to dmpc and are no command of their own.
#pragma once

#include <filesystem>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

/// A part of dmpc is missing or is not this dmpc's: no bug, though dmpc cannot go on. The message says which, and what to do.
struct InstallationError : core::InternalError {
  using core::InternalError::InternalError;
};

/// A file beside the running program (in the folder where it was built), in `installed`, a folder seen from there (where it is
/// installed), or in ../apps (for the tests); nowhere else, whatever the environment says. `what` names it in the
/// InstallationError, with the places, that is thrown if it is in none of them: "the program x, which reads foreign files for
/// dmpc,".
std::filesystem::path companion_path(const std::string& name, const std::string& installed, const std::string& what);

}  // namespace dmpc::apps
