#include "apps/frontend/line/text_table.h"

#include <doctest/doctest.h>

#include <string_view>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps::text_table_test {

using Parts = std::vector<std::string_view>;

TEST_CASE("a table's rows are its lines but for comments and empty ones, their cells without the blanks around them") {
  const auto rows = table_rows("# of what\n\none | two words |\n  | | three", 3);
  CHECK(rows == std::vector<Parts>{{"one", "two words", ""}, {"", "", "three"}});
  CHECK(table_rows("a => b|c", 2, "=>") == std::vector<Parts>{{"a", "b|c"}});
  CHECK(table_rows("", 1).empty());
}

TEST_CASE("a row with a cell too few or too many is an error of the program") {
  CHECK_THROWS_AS(table_rows("a | b\nc", 2), core::InternalError);
  CHECK_THROWS_AS(table_rows("a | b | c", 2), core::InternalError);
}

}  // namespace dmpc::apps::text_table_test
