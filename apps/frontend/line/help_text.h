// What --help prints about a command, and how a terminal shows it.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// A text of help_text() in lines of at most `width` letters, where words are not longer: explanations go on below their
/// beginning, or, where there is little room beside the names, below those. Lines to be typed stay whole.
std::string fitted_help(const std::string& text, std::size_t width);

/// Writes the text, as wide as the terminal if `output` is the standard output and that is one; as it is to files and pipes.
void print_help(std::ostream& output, const std::string& text);

/// Where explanations begin.
inline constexpr std::size_t help_column = 36;

/// `path`: the program's name and the command's, "dmpc study balance".
std::string help_text(const CommandDescription& command, const std::string& path);

}  // namespace dmpc::apps
