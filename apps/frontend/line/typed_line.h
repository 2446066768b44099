// What a user typed, word for word held against the commands and options that there are. Every complaint about the form of a line
// is worded here.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/line/command_description.h"

namespace dmpc::apps {

/// A line that has the form of a command.
struct TypedLine {
  std::string command;            ///< "study balance"
  bool asks_for_help = false;     ///< about `command`, which may be empty; nothing else of the line counts
  bool asks_for_version = false;  ///< the program's version
  /// The line in one form: the commands, each option as --name or --name=value, --, and all arguments.
  std::vector<std::string> words;
};

/// Options are written --name=value, --name value, -n value or -nvalue; after -- all words are arguments. Throws
/// core::UsageError for a command or option that there is none, a value that is missing or too much, an option given twice that
/// takes one value, and what is required and missing. The message says what would do, and ends with a hint at the right --help.
TypedLine read_line(const CommandDescription& program, std::span<const std::string> arguments);

/// "\nTry: dmpc study --help", for `command` "study" of the program "dmpc".
std::string hint_at_help(const std::string& command, const std::string& program = "dmpc");

/// What the user types and what help says of its value: "--nodes=1..1023"; what has no long name with a blank: "-o IMAGE".
std::string typed_form(const OptionDescription& option);

/// "a", "a or b", "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// What help shows of an option's value, without its default.
std::string value_alone(const OptionDescription& option);

}  // namespace dmpc::apps
