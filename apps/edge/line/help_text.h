// What --help prints about a command.
#pragma once

#include <cstddef>
#include <string>

#include "apps/edge/line/command_description.h"

namespace dmpc::apps {

/// Where explanations begin.
inline constexpr std::size_t help_column = 36;

/// `path`: the program's name and the command's, "dmpc study balance".
std::string help_text(const CommandDescription& command, const std::string& path);

}  // namespace dmpc::apps
