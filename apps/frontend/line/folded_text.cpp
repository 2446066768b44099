#include "apps/frontend/line/folded_text.h"

#include <sstream>
#include <vector>

namespace dmpc::apps {
namespace {

/// "-", "#x" and "12." would begin something else in Markdown.
bool looks_like_mark(const std::string& word) {
  const bool is_numbered = word.back() == '.' && word.find_first_not_of("0123456789.") == std::string::npos;
  return is_numbered || std::string_view("-+*#>=").find(word.front()) != std::string_view::npos;
}

/// Words, each with those behind it that must not begin a line.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::istringstream stream{std::string(text)};
  for (std::string word; stream >> word;) {
    if (!words.empty() && looks_like_mark(word)) {
      words.back() += " " + word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace

std::string folded(std::string_view text, std::size_t width, std::string_view indent) {
  std::string lines;
  std::size_t line_size = 0;
  for (const std::string& word : words_of(text)) {
    const bool fits = line_size + 1 + word.size() <= width;
    if (line_size > 0 && fits) {
      lines += " " + word;
      line_size += 1 + word.size();
    } else {
      lines += lines.empty() ? "" : "\n" + std::string(indent);
      line_size = (lines.empty() ? 0 : indent.size()) + word.size();
      lines += word;
    }
  }
  return lines;
}

}  // namespace dmpc::apps
