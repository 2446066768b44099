#include "apps/frontend/line/folded_text.h"

#include <doctest/doctest.h>

namespace dmpc::apps::folded_text_test {

TEST_CASE("a text is folded between words, and what is longer than a line stands alone") {
  CHECK(folded("one two three", 7, "  ") == "one two\n  three");
  CHECK(folded("one two three", 13, "  ") == "one two three");
  CHECK(folded("a incomprehensible b", 4, "") == "a\nincomprehensible\nb");
  CHECK(folded("", 4, "  ").empty());
}

TEST_CASE("no folded line begins with what Markdown takes for a mark") {
  CHECK(folded("- four - five", 8, "  ") == "- four -\n  five");
  CHECK(folded("ends at 12. Next", 8, "  ") == "ends\n  at 12.\n  Next");
}

}  // namespace dmpc::apps::folded_text_test
