// Descriptions of the declared commands and options, from which the man page and shell completion are written.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dmpc::apps {

/// Values that a shell may offer. Empty for a number or a text that only the user knows.
struct Suggestion {
  std::vector<std::string> words;  ///< one that ends in a colon is followed by a file
  bool files = false;
  bool folders = false;
  std::vector<std::string> endings;  ///< extensions of the files; none: all files
};

/// An option, or an argument, which has no names.
struct OptionDescription {
  std::vector<std::string> names;  ///< as the user types them, the short one first: "-o", "--output"
  std::string value;               ///< its value as help shows it, "1..255 [5]", or an argument's name; empty for a flag
  std::string text;                ///< what it does; may have several lines
  std::string group;               ///< the title below which help lists it
  bool is_required = false;
  bool has_optional_value = false;  ///< a flag that may have one, behind an =
  std::string standard;             ///< the default of an optional value
  bool is_repeatable = false;       ///< may be given several times, or is a flag
  bool is_list = false;             ///< several values, separated by commas; for an argument, separate words
  Suggestion suggestion;

  friend bool operator==(const OptionDescription& a, const OptionDescription& b) {
    return a.names == b.names && a.value == b.value && a.text == b.text;
  }
};

/// Options that matter first, below a title. A row is an option's name, as "--nodes N", and what it does in a few words.
struct BriefGroup {
  std::string title;
  std::vector<std::pair<std::string, std::string>> rows;
};

/// A command, or the program itself.
struct CommandDescription {
  std::string name;      ///< without the names of the commands that contain it
  std::string text;      ///< what it does
  std::string examples;  ///< the end of its help
  std::vector<OptionDescription> arguments;
  std::vector<OptionDescription> options;  ///< grouped; the first is --help
  std::vector<CommandDescription> commands;
  std::vector<BriefGroup> brief;  ///< what --help shows, and --help=all does not; none: all
};

/// By the name of the value in help.
using Suggestions = std::map<std::string, Suggestion>;

/// Suggestions for a value that help shows as `shown`: "SIZE|auto [auto]".
Suggestion suggestion_for(const std::string& shown, const Suggestions& known);

}  // namespace dmpc::apps
