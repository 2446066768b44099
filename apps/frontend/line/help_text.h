// The text of --help for a command, and its layout on a terminal.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// Wraps a text of help_text() to `width` letters, unless words are longer. Explanations continue below their beginning, or,
/// where there is little space beside the names, below those. Lines to be typed are not broken.
std::string fitted_help(const std::string& text, std::size_t width);

/// Writes the text, wrapped to the terminal if `output` is the standard output and a terminal; unchanged to files and pipes.
void print_help(std::ostream& output, const std::string& text);

/// Column in which explanations begin.
inline constexpr std::size_t help_column = 36;

/// Everything about a command. `path`: the program's name and the command's, "dmpc study balance".
std::string help_text(const CommandDescription& command, const std::string& path);

/// The options that matter first, or everything if the command does not say which do.
std::string brief_help_text(const CommandDescription& command, const std::string& path);

}  // namespace dmpc::apps
