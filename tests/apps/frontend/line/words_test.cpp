#include "apps/frontend/line/words.h"

#include <doctest/doctest.h>

namespace words_test {

using dmpc::apps::words_between_commas;

TEST_CASE("words stand between commas") {
  using Words = std::vector<std::string>;
  CHECK(words_between_commas("one", "--x") == Words{"one"});
  CHECK(words_between_commas("one,two,one", "--x") == Words{"one", "two", "one"});
  CHECK(words_between_commas(" ", "--x") == Words{" "});
}

TEST_CASE("an empty word in a list is refused, wherever it stands") {
  for (const char* text : {"", ",", "one,", ",one", "one,,two"}) {
    CHECK_THROWS_WITH_AS(words_between_commas(text, "--x"), doctest::Contains("a word is missing"), dmpc::core::UsageError);
  }
  CHECK_THROWS_WITH_AS(words_between_commas("one,", "--x"), doctest::Contains("--x=one,: "), dmpc::core::UsageError);
}

}  // namespace words_test
