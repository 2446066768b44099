// Where the programs and modules lie that belong to dmpc and are no command of their own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

/// A part of dmpc is missing or is not this dmpc's: no bug, though dmpc cannot go on. The message says which, and what to do.
struct InstallationError : core::InternalError {
  using core::InternalError::InternalError;
};

/// Whose companion a file is.
enum class CompanionOf : std::uint8_t {
  dmpc,        ///< lies beside dmpc where it is built, and in a folder beside its own where it is installed
  own_program  ///< only in absolute folders of the run path: for a user's own program, which may lie anywhere
};

/// A file in one of its places, absolute and without links; nowhere else, whatever the environment says. For `dmpc` these are the
/// folder of the running program and `installed`, a folder seen from there; for either, and for a program in a folder `tests`,
/// the `apps` beside that folder, as builds have them. One that others than dmpc's own user may have written (trusted_path.h) is
/// passed over. `what` names it in the InstallationError, with the places and whom they do not keep out, that is thrown if it
/// is in none of them: "the program x, which reads foreign files for dmpc,".
std::filesystem::path companion_path(const std::string& name, const std::string& installed, const std::string& what,
                                     CompanionOf whose = CompanionOf::dmpc);

}  // namespace dmpc::apps
