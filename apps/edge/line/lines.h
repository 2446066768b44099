// A text as its lines, and words as a text.
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::apps {

/// The lines of a text without their ends; what follows the last end is a line unless it is empty.
inline std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// All of the words, with `between` between them.
inline std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

}  // namespace dmpc::apps
