// Checks a typed line against the declared commands and options. All error messages about the form of a line are here.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// A line that has the form of a command.
struct TypedLine {
  std::string command;             ///< "study balance"
  bool asks_for_help = false;      ///< for `command`, which may be empty; the rest of the line is ignored
  bool asks_for_all_help = false;  ///< as --help=all does
  bool asks_for_version = false;   ///< the program's version
  /// The line in canonical form: the commands, each option as --name or --name=value, --, and all arguments.
  std::vector<std::string> words;
};

/// Options are written --name=value, --name value, -n value or -nvalue; after -- all words are arguments. Throws core::UsageError
/// for an unknown command or option, a missing or superfluous value, a repeated option that takes one value, and missing
/// mandatory ones. The message says what is expected, and ends with a hint at the right --help.
TypedLine read_line(const CommandDescription& program, std::span<const std::string> arguments);

/// "\nTry: dmpc study --help", for `command` "study" of the program "dmpc".
std::string hint_at_help(const std::string& command, const std::string& program = "dmpc");

/// The option as the user types it, with its value as help shows it: "--nodes=1..1023"; an option without a long name has a
/// blank: "-o IMAGE".
std::string typed_form(const OptionDescription& option);

/// "a", "a or b", "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// The option's value as help shows it, without its default.
std::string value_alone(const OptionDescription& option);

}  // namespace dmpc::apps
