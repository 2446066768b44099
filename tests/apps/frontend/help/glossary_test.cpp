#include "apps/frontend/help/glossary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/support/text.h"

namespace dmpc::apps::glossary_test {

TEST_CASE("the glossary is in order, has no word twice, and ends its sentences") {
  const auto words = glossary();
  CHECK(std::adjacent_find(words.begin(), words.end(), [](const auto& a, const auto& b) { return a.word >= b.word; }) ==
        words.end());
  for (const GlossaryEntry& entry : words) {
    CHECK_MESSAGE((!entry.meaning.empty() && entry.meaning.back() == '.'), entry.word);
  }
}

TEST_CASE("a word occurs by itself, in the plural and with a capital") {
  CHECK(occurs("fault", "12 faults"));
  CHECK(occurs("fetch", "Fetches: who asks"));
  CHECK(occurs("pixel in flight", "8 pixels in flight."));
  CHECK(occurs("work item", "one work item"));
  CHECK(occurs("fault", "default, faulty, a fault"));
}

TEST_CASE("a part of a word is another word") {
  CHECK_FALSE(occurs("fault", "default"));
  CHECK_FALSE(occurs("hop", "shops chopped"));
  CHECK_FALSE(occurs("home", ""));
}

TEST_CASE("the glossary as text says every word once, on lines that fit a terminal") {
  const std::string text = glossary_text();
  std::istringstream lines(text);
  std::size_t heads = 0;
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() <= 100);
    CHECK_FALSE(line.ends_with(" "));
    heads += line.starts_with(" ") ? 0 : 1;
  }
  CHECK(heads == glossary().size());
  CHECK(tests::contains(text, "work item           A square of pixels, 4x4 (3x3 where"));
}

}  // namespace dmpc::apps::glossary_test
