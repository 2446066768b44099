// Whether code in a file may run as the user who runs this process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Returns why `path`, which has to be absolute and without links, may not be opened as code, as "it belongs to user 1001".
/// Returns nothing if only trusted users can write or replace it: root, the process's own user, and the owner of the running
/// program. The file and each folder above it must belong to one of them and must not be writable for their group or for others,
/// except for folders with the sticky bit, where each user may remove only his own files. A group of which the user is the only
/// member counts as the user, root's group as root, and a group that may replace the running program as its owner; other entries
/// of an access list are not trusted. A folder above the running program, too, passes: whoever may write there may replace that
/// program.
///
/// In a user namespace that does not know the owners of files, as in single-user containers, an unknown owner passes, but what
/// others may write does not.
std::optional<std::string> why_untrusted(const std::filesystem::path& path);

/// Likewise for an open file alone, wherever it lies: whoever may replace it in its folder has files of his own.
std::optional<std::string> why_untrusted(const Descriptor& file);

/// Opens code that a user names, for reading. The opened file itself is checked, so nobody can replace it in between, and the
/// folders above it more strictly: nothing is trusted where everybody may write, as in /tmp. Throws core::InputError, whose
/// message begins with the path, if the path is not absolute or is reached by links, the file is no ordinary one, or others can
/// write it.
Descriptor open_trusted(const std::string& path);

}  // namespace dmpc::apps
