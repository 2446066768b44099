#include "apps/frontend/ranks/compatibility.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <fstream>
#include <sstream>

#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// The first line of `text` that stands elsewhere or not at all in `other`; "nothing" if `text` ends there.
std::string first_difference(const std::string& text, const std::string& other) {
  const std::vector<std::string> lines = lines_of(text), others = lines_of(other);
  const std::size_t both = std::min(lines.size(), others.size());
  const auto place = std::mismatch(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(both), others.begin()).first;
  return place == lines.end() ? "nothing" : *place;
}

/// As the system has them, on one line; a word with a blank in it cannot be told from two, which is no great loss.
std::string words_of_call() {
  std::ostringstream text;
  text << std::ifstream("/proc/self/cmdline", std::ios::binary).rdbuf();
  std::string words = text.str();
  words.erase(0, words.find('\0'));  // what the program is called, whose place may be another on each computer
  words.erase(0, 1);
  words.erase(words.find_last_not_of('\0') + 1);
  std::replace_if(
      words.begin(), words.end(), [](char letter) { return letter == '\0' || letter == '\n'; }, ' ');
  return words.empty() ? "(none)" : words;
}

}  // namespace

Compatibility build_compatibility() {
  return {{"version of dmpc", DMPC_VERSION},
          {"build", DMPC_MODULES_BUILD},
          {"byte order", std::endian::native == std::endian::little ? "little" : "big"}};
}

Compatibility call_compatibility() {
  Compatibility compatibility = build_compatibility();
  compatibility.emplace_back("the words", words_of_call());
  return compatibility;
}

std::string text_of(const Compatibility& compatibility) {
  std::string text;
  for (const auto& [what, value] : compatibility) {
    text += what;
    text += ' ';
    text += value;
    text += '\n';
  }
  return text;
}

void expect_alike(std::span<const std::string> texts, std::span<const std::string> names) {
  for (std::size_t rank = 1; rank < texts.size(); ++rank) {
    if (texts[rank] != texts[0]) {
      throw core::InputError("the ranks are not compatible, so they cannot compute one result: " + names[rank] + " has " +
                             first_difference(texts[rank], texts[0]) + ", " + names[0] + " has " +
                             first_difference(texts[0], texts[rank]) + ": start the same on all of them");
    }
  }
}

}  // namespace dmpc::apps
