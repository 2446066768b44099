// Lists on the command line: words with commas, or another mark, between.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

/// The words between marks: one at least, perhaps empty.
inline std::vector<std::string> words_between(const std::string& text, char mark) {
  std::vector<std::string> words;
  std::istringstream stream(text + mark);
  for (std::string word; std::getline(stream, word, mark);) {
    words.push_back(word);
  }
  return words;
}

/// The words between commas, one at least. Throws core::UsageError naming `option` if one is empty.
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
