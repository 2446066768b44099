#include "nodes/program.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::nodes::level_test {

TEST_CASE("levels stand in the order in which they are given, and there may be none") {
  std::string names;
  for (const Level& level : Levels{{"a", 1}, {"b", 2}}) {
    names += std::string(level.name) + std::to_string(level.value);
  }
  CHECK(names == "a1b2");
  const Levels none;
  CHECK(none.begin() == none.end());
}

TEST_CASE("a program has at most four levels") {
  const Levels four = {{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}};
  CHECK(four.end() - four.begin() == Levels::count_max);
  CHECK_THROWS_AS((Levels{{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}, {"e", 5}}), core::InternalError);
}

}  // namespace dmpc::nodes::level_test
