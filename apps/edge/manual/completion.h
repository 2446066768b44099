// Scripts by which shells complete a line that is being typed.
#pragma once

#include <string>

#include "apps/edge/line/command_description.h"

namespace dmpc::apps {

/// Scripts for bash (4.4 or later; bash-completion is not needed), zsh and fish, for a program called `dmpc`. They offer
/// commands, options, the words that an option or argument takes, and files or folders where it takes one. Names and words must
/// consist of letters, digits, hyphens and dots; texts may be any, of which the first line is shown by the shells that show one.
std::string bash_completion(const CommandDescription& program);
std::string zsh_completion(const CommandDescription& program);
std::string fish_completion(const CommandDescription& program);

}  // namespace dmpc::apps
