#include "apps/frontend/help/glossary.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

#include "apps/frontend/line/text_table.h"
#include "core/base/ranges.h"

namespace dmpc::apps {

extern const char* const glossary_file;  // defined in a source that CMake generates from glossary.txt

namespace {

constexpr std::size_t line_letters_max = 100;

bool is_letter(char character) { return std::isalnum(static_cast<unsigned char>(character)) != 0; }

bool are_alike(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Nothing, or the ending of a plural, and then the word's end.
bool ends_word(std::string_view rest) {
  for (const std::string_view ending : {"es", "s", ""}) {
    if (rest.substr(0, ending.size()) == ending && (rest.size() == ending.size() || !is_letter(rest[ending.size()]))) {
      return true;
    }
  }
  return false;
}

/// "pixel in flight" has its plural in the middle.
std::string plural_of_first(std::string_view word) {
  const std::size_t space = word.find(" in ");
  return space == std::string_view::npos ? std::string(word)
                                         : std::string(word.substr(0, space)) + "s" + std::string(word.substr(space));
}

bool occurs_as(std::string_view form, std::string_view text) {
  for (auto from = text.begin();;) {
    const auto at = std::search(from, text.end(), form.begin(), form.end(), are_alike);
    if (at == text.end()) {
      return false;
    }
    const std::string_view rest = text.substr(static_cast<std::size_t>(at - text.begin()) + form.size());
    if ((at == text.begin() || !is_letter(at[-1])) && ends_word(rest)) {
      return true;
    }
    from = at + 1;
  }
}

/// The text wrapped to lines that begin with `margin`, except the first.
std::string wrapped(std::string_view text, const std::string& margin) {
  std::string lines;
  std::size_t used = margin.size();
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    const bool is_full = used + 1 + word.size() > line_letters_max;
    lines += is_full ? "\n" + margin : used == margin.size() ? "" : " ";
    used = (is_full || used == margin.size() ? margin.size() : used + 1) + word.size();
    lines += word;
    text.remove_prefix(std::min(text.size(), word.size() + 1));
  }
  return lines + "\n";
}

}  // namespace

std::span<const GlossaryEntry> glossary() {
  static const auto entries = core::mapped<GlossaryEntry>(table_rows(glossary_file, 2), [](const auto& row) {
    return GlossaryEntry{row[0], row[1]};
  });
  return entries;
}

bool occurs(std::string_view word, std::string_view text) {
  return occurs_as(word, text) || occurs_as(plural_of_first(word), text);
}

std::string glossary_text() {
  const std::size_t width =
      core::max_over(glossary(), std::size_t{0}, [&](const GlossaryEntry& entry) { return entry.word.size() + 2; });
  std::string text;
  for (const GlossaryEntry& entry : glossary()) {
    text +=
        std::string(entry.word) + std::string(width - entry.word.size(), ' ') + wrapped(entry.meaning, std::string(width, ' '));
  }
  return text;
}

}  // namespace dmpc::apps
