#include "apps/frontend/manual/roff.h"

#include <doctest/doctest.h>

namespace dmpc::apps::roff_test {

TEST_CASE("words and blanks stand for themselves in roff") {
  CHECK(roff("").empty());
  CHECK(roff("Two words: 1,5 (and so on)") == "Two words: 1,5 (and so on)");
}

TEST_CASE("roff takes nothing of a text for an order, an escape or a quotation mark") {
  CHECK(roff(".br") == "\\&.br");
  CHECK(roff("a\n.br.") == "a\n\\&.br.");
  CHECK(roff("a\\fB") == "a\\(rsfB");
  CHECK(roff("'br \"a\"") == "\\(aqbr \\(dqa\\(dq");
}

TEST_CASE("what is copied from a page can be typed") {
  CHECK(roff("--a=`b`") == "\\-\\-a=\\(gab\\(ga");
  CHECK(roff("~^") == "\\(ti\\(ha");
}

TEST_CASE("a paragraph that begins a section has no order of its own") {
  ManualPage page("T", "t 1");
  page.begin_section("A");
  page.add_paragraph("one");
  page.add_paragraph("two");
  CHECK(page.text().find(".SH \"A\"\none\n.PP\ntwo\n") != std::string::npos);
}

TEST_CASE("lines keep their blanks, and no line is lost") {
  ManualPage page("T", "t 1");
  page.add_lines("a  b\n\nc");
  CHECK(page.text().find(".nf\na  b\n\\&\nc\n.fi\n") != std::string::npos);
}

TEST_CASE("long texts are cut at blanks, which does not make an order of what follows") {
  ManualPage page("T", "t 1");
  page.begin_section("A");
  page.add_paragraph(std::string(77, 'a') + " .b");
  CHECK(page.text().find("aa\n\\&.b\n") != std::string::npos);
}

}  // namespace dmpc::apps::roff_test
