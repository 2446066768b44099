// Whether code in a file may run as the user who runs this process.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dmpc::apps {

/// Why `path`, which has to be absolute and without links, may not be opened as code, as "it belongs to user 1001"; nothing if
/// nobody can have written it, or can put another in its place, but those whose code this process runs anyway: root, its own
/// user, and the owner of the program that it runs. That is asked of the file and of each folder above it: whose they are, and
/// that neither their group nor others may write there, but into folders where each may remove only what is his own (the sticky
/// bit). A group that is the user's alone counts as the user, root's as root, and one that may replace the
/// running program as its owner. A folder that the running program lies below, too, passes: whoever may write there may replace that.
///
/// Whose files are in a user namespace that does not know their owners, as containers of one user have it, cannot be told: such
/// an owner passes, what may be written does not.
std::optional<std::string> why_untrusted(const std::filesystem::path& path);

}  // namespace dmpc::apps
