// Whether code in a file may run as the user who runs this process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/frontend/system/descriptor.h"

namespace dmpc::apps {

/// Why `path`, which has to be absolute and without links, may not be opened as code, as "it belongs to user 1001"; nothing if
/// nobody can have written it, or can put another in its place, but those whose code this process runs anyway: root, its own
/// user, and the owner of the program that it runs. That is asked of the file and of each folder above it: whose they are, and
/// that neither their group nor others may write there, but into folders where each may remove only what is his own (the sticky
/// bit). A group that is the user's alone counts as the user, root's as root, and one that may replace the running program as its
/// owner; who else an access list lets write counts as none of them. A folder that the running program lies below, too, passes:
/// whoever may write there may replace that.
///
/// Whose files are in a user namespace that does not know their owners, as containers of one user have it, cannot be told: such
/// an owner passes, what may be written does not.
std::optional<std::string> why_untrusted(const std::filesystem::path& path);

/// Opens code that a user names, for reading. That is asked of the opened file itself, so nobody can put another in its place in
/// between, and of the folders above it more strictly: where everybody may write, as in /tmp, nothing is trusted. Throws
/// core::InputError, whose message begins with the path: it is not absolute, is reached by links, is no ordinary file, or others
/// can write it.
Descriptor open_trusted(const std::string& path);

}  // namespace dmpc::apps
