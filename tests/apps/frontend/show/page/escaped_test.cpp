#include "apps/frontend/show/page/escaped.h"

#include <doctest/doctest.h>

namespace dmpc::apps::html::escaped_test {

TEST_CASE("what means something to HTML is shown as it is") {
  CHECK(escaped("<b class=\"x\">a & b's</b>") == "&lt;b class=&quot;x&quot;&gt;a &amp; b&#39;s&lt;/b&gt;");
  CHECK(escaped("").empty());
  CHECK(escaped("rings-4-t1, 8 nodes") == "rings-4-t1, 8 nodes");
}

TEST_CASE("whole characters of UTF-8 stay") {
  for (const char* const text : {"é", "€", "\xF0\x9F\x8E\xA8", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"}) {
    CHECK(escaped(text) == text);
  }
}

TEST_CASE("bytes that are no UTF-8 are replaced, each by itself") {
  const std::string unknown = "\xEF\xBF\xBD";
  CHECK(escaped("a\xFF!") == "a" + unknown + "!");
  CHECK(escaped("\xC3") == unknown);                                            // cut off
  CHECK(escaped("\xE2\x82<") == unknown + unknown + "&lt;");                    // cut off before a tag
  CHECK(escaped("\xC0\x80") == unknown + unknown);                              // longer than needed
  CHECK(escaped("\xED\xA0\x80") == unknown + unknown + unknown);                // a surrogate
  CHECK(escaped("\xF4\x90\x80\x80") == unknown + unknown + unknown + unknown);  // beyond Unicode
}

TEST_CASE("control characters become spaces, but line ends and tabs stay") {
  CHECK(escaped(std::string_view("a\0b\x1b\x7f", 5)) == "a b  ");
  CHECK(escaped("a\n\tb") == "a\n\tb");
}

}  // namespace dmpc::apps::html::escaped_test
