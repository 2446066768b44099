// Splits texts into lines and words; lists on the command line are separated by commas or another mark.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

/// The lines of a text without their ends; the text after the last end is a line unless it is empty.
inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// Joins the words, or text_of() of each, with `between`.
template <class Words = std::vector<std::string>, class TextOf = std::identity>
std::string joined(const Words& words, const std::string& between, const TextOf& text_of = {}) {
  std::string text;
  for (const auto& word : words) {
    text += (text.empty() ? "" : between) + std::string(text_of(word));
  }
  return text;
}

/// Quotes any word for a shell.
inline std::string in_quotes(std::string_view word) {
  std::string quoted = "'";
  for (const char letter : word) {
    quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return quoted + "'";
}

/// The words between marks: at least one, which may be empty.
inline std::vector<std::string> words_between(const std::string& text, char mark) {
  std::vector<std::string> words;
  std::istringstream stream(text + mark);
  for (std::string word; std::getline(stream, word, mark);) {
    words.push_back(word);
  }
  return words;
}

/// The words between commas, at least one. Throws core::UsageError naming `option` if one is empty.
inline std::vector<std::string> words_between_commas(const std::string& text, const std::string& option) {
  std::vector<std::string> words = words_between(text, ',');
  for (const std::string& word : words) {
    if (word.empty()) {
      throw core::UsageError(option + "=" + text + ": a word is missing; expected words with commas between");
    }
  }
  return words;
}

}  // namespace dmpc::apps
