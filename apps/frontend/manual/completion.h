// The completion script for bash.
#pragma once

#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// For bash (4.4 or later; bash-completion is not needed) and a program called `dmpc`. It offers commands, options, the words
/// that an option or argument takes, and files or folders where it takes one. Names and words must consist of letters, digits,
/// hyphens and dots.
std::string bash_completion(const CommandDescription& program);

}  // namespace dmpc::apps
