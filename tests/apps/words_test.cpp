#include "apps/words.h"

#include <doctest/doctest.h>

using dmpc::apps::words_between_commas;

TEST_CASE("words stand between commas, empty ones too") {
  using Words = std::vector<std::string>;
  CHECK(words_between_commas("") == Words{""});
  CHECK(words_between_commas("one") == Words{"one"});
  CHECK(words_between_commas("one,two") == Words{"one", "two"});
  CHECK(words_between_commas(",one,,") == Words{"", "one", "", ""});
}
