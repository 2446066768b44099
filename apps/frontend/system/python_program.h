// Programs in Python that are commands of dmpc.
#pragma once

#include <string>
#include <vector>

namespace dmpc::apps {

/// Becomes Python (Debian's, for which packages bring modules, if it is there), which calls main(words) of the module `dmpc.NAME`
/// with this dmpc for its renders. If a module is missing, that says by which package it comes, as `what` needs it. Throws
/// InstallationError if there is no Python.
[[noreturn]] void become_python(const std::string& name, const std::string& what, const std::vector<std::string>& words);

}  // namespace dmpc::apps
