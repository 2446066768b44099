// What is declared of commands and options, for those who write about them: the man page, completion in shells.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace dmpc::apps {

/// What a shell may offer for a value. Nothing at all: a number or a text that only the user knows.
struct Suggestion {
  std::vector<std::string> words;  ///< one that ends in a colon is followed by a file
  bool files = false;
  bool folders = false;
  std::vector<std::string> endings;  ///< extensions of the files; none: all files
};

/// An option, or an argument, which has no names.
struct OptionDescription {
  std::vector<std::string> names;  ///< as the user types them, the short one first: "-o", "--output"
  std::string value;               ///< what help says of it, "1..255 [5]", or an argument's name; empty for a flag
  std::string text;                ///< what it does; may have several lines
  std::string group;               ///< the title below which help lists it
  bool is_required = false;
  bool has_optional_value = false;  ///< a flag that may have one, behind an =
  std::string standard;             ///< which it has then without one
  bool is_repeatable = false;       ///< may be given several times, or is a flag
  bool is_list = false;             ///< several values: with commas between, of an argument as words of their own
  Suggestion suggestion;

  friend bool operator==(const OptionDescription& a, const OptionDescription& b) {
    return a.names == b.names && a.value == b.value && a.text == b.text;
  }
};

/// A command, or the program itself.
struct CommandDescription {
  std::string name;      ///< without those of the commands that it is one of
  std::string text;      ///< what it does
  std::string examples;  ///< what help says in the end
  std::vector<OptionDescription> arguments;
  std::vector<OptionDescription> options;  ///< all of a group in succession; the first is --help
  std::vector<CommandDescription> commands;
};

/// By what help calls a value.
using Suggestions = std::map<std::string, Suggestion>;

/// What a shell may offer for a value of which help shows this: "SIZE|auto [auto]".
Suggestion suggestion_for(const std::string& shown, const Suggestions& known);

}  // namespace dmpc::apps
