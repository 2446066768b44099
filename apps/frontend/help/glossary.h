// The glossary of dmpc's terms, for its pages and its help.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A term in lower case and the singular, with its meaning in a sentence or two.
struct GlossaryEntry {
  std::string_view word;
  std::string_view meaning;
};

/// Returns all entries in alphabetical order. Thread-safe.
std::span<const GlossaryEntry> glossary();

/// Whether the word occurs in the text as a whole word, also in the plural and at the beginning of a sentence.
bool occurs(std::string_view word, std::string_view text);

/// The whole list as lines of at most 100 letters, with the words in a column of their own.
std::string glossary_text();

}  // namespace dmpc::apps
