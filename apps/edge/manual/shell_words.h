// What the completion scripts of all shells are made from.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "apps/edge/line/command_description.h"

namespace dmpc::apps {

/// All of them, with blanks between.
inline std::string with_blanks(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

inline std::vector<std::string> names_of(const std::vector<CommandDescription>& commands) {
  std::vector<std::string> names;
  for (const CommandDescription& command : commands) {
    names.push_back(command.name);
  }
  return names;
}

/// Whatever one of them may be.
inline Suggestion suggestion_of(const std::vector<OptionDescription>& arguments) {
  Suggestion all;
  for (const OptionDescription& argument : arguments) {
    const Suggestion& one = argument.suggestion;
    all.words.insert(all.words.end(), one.words.begin(), one.words.end());
    all.files = all.files || one.files;
    all.folders = all.folders || one.folders;
    all.endings.insert(all.endings.end(), one.endings.begin(), one.endings.end());
  }
  return all;
}

/// Whether files follow some words (Suggestion::words).
inline bool has_colons(const Suggestion& suggestion) {
  return std::any_of(suggestion.words.begin(), suggestion.words.end(),
                     [](const std::string& word) { return word.back() == ':'; });
}

inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The text between single quotation marks; `quote` is what stands for one within.
inline std::string quoted(const std::string& text, const std::string& quote) {
  std::string all = "'";
  for (const char character : text) {
    all += character == '\'' ? quote : std::string(1, character);
  }
  return all + "'";
}

}  // namespace dmpc::apps
