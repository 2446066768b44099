// What --help prints about a command.
#pragma once

#include <string>

#include "apps/edge/line/command_description.h"

namespace dmpc::apps {

/// `path`: the program's name and the command's, "dmpc study balance".
std::string help_text(const CommandDescription& command, const std::string& path);

}  // namespace dmpc::apps
