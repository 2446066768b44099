// Lists on the command line: words with commas between.
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace dmpc::apps {

/// The words between commas: one at least, perhaps empty.
inline std::vector<std::string> words_between_commas(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    words.push_back(word);
  }
  return words;
}

}  // namespace dmpc::apps
