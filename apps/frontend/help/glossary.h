// What dmpc's words mean: one list, for its pages and its help.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// A word in lower case and the singular, and a sentence or two that say what it means.
struct GlossaryEntry {
  std::string_view word;
  std::string_view meaning;
};

/// By alphabet. Thread-safe.
std::span<const GlossaryEntry> glossary();

/// Whether the word stands in the text by itself, also in the plural and at the beginning of a sentence.
bool occurs(std::string_view word, std::string_view text);

/// The whole list as lines of at most 100 letters, with the words in a column of their own.
std::string glossary_text();

}  // namespace dmpc::apps
