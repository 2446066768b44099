// Programs in Python that are commands of dmpc.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// Debian's Python, for which packages bring modules, if it is there, else that of PATH.
std::string python();
/// The arguments with which Python calls main(words) of the module `dmpc.NAME`. If a module is missing, that says by which
/// package it comes, as `what` needs it.
std::vector<std::string> python_words(const std::string& name, const std::string& what, const std::vector<std::string>& words);

/// Returns the path of a nameless file with these bytes, for become_python(): it is there until that Python ends. Throws as
/// MemoryFile does.
std::string file_for_python(std::string_view bytes);

/// Becomes Python with these arguments, and this dmpc for its renders. Throws InstallationError if there is no Python.
[[noreturn]] void become_python(const std::string& name, const std::string& what, const std::vector<std::string>& words);

}  // namespace dmpc::apps
