#include "apps/computer/page_parts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace dmpc::apps::page_words_test {

using html::page_words;

TEST_CASE("words stand once each and by alphabet, those that dmpc has in common among them") {
  std::vector<std::string_view> words;
  for (const GlossaryEntry& entry : page_words()) {
    words.push_back(entry.word);
  }
  CHECK(std::is_sorted(words.begin(), words.end()));
  CHECK(std::adjacent_find(words.begin(), words.end()) == words.end());
  for (const std::string_view word : {"computing", "fault", "idle at the end", "link", "page", "virtual time"}) {
    CHECK_MESSAGE(std::find(words.begin(), words.end(), word) != words.end(), word);
  }
  CHECK(words.size() == 27);
}

TEST_CASE("no word is explained by rays and pictures") {
  for (const GlossaryEntry& entry : page_words()) {
    for (const std::string_view word : {" ray", "pixel", "film", "scene", "dmpc"}) {
      CHECK_MESSAGE(entry.meaning.find(word) == std::string_view::npos, entry.meaning);
    }
  }
}

}  // namespace dmpc::apps::page_words_test
