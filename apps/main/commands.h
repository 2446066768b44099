// All commands of dmpc: the renderer's and the laboratory's.
#pragma once

#include <span>
#include <string>

#include "apps/frontend/line/command_description.h"
#include "apps/program/commands.h"

namespace dmpc::apps {

/// `arguments` without the program's name. Throws core::UsageError, whose message ends with a hint at the right --help, for
/// anything wrong that can be seen without reading a file.
Command parse_command_line(std::span<const std::string> arguments);

/// All commands with all options, as parse_command_line() takes them.
CommandDescription describe_command_line();

}  // namespace dmpc::apps
