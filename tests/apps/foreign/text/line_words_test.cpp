// Lines, words and numbers of foreign files that are text.

#include "apps/foreign/text/line_words.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/foreign/text/text_lines.h"
#include "core/base/expect.h"

namespace dmpc::apps::line_words_test {

namespace {

std::vector<std::string> lines_of(std::string_view file, LineJoin join = LineJoin::none) {
  std::vector<std::string> all;
  for (TextLines lines(file, join); lines.next();) {
    all.push_back(std::to_string(lines.number()) + " " + std::string(lines.line()));
  }
  return all;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> all;
  LineWords words(line, 1);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    all.emplace_back(word);
  }
  return all;
}

using List = std::vector<std::string>;

}  // namespace

TEST_CASE("a line ends with a line feed, a carriage return or both, and the last one may end with nothing") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    CHECK(lines_of("a" + end + end + "b c" + end) == List{"1 a", "2 ", "3 b c"});
    CHECK(lines_of("a" + end + "b") == List{"1 a", "2 b"});
  }
  CHECK(lines_of("").empty());
  CHECK(lines_of("\xef\xbb\xbf").empty());
  CHECK(lines_of("\xef\xbb\xbf"
                 "a\n\x1a") == List{"1 a"});
}

TEST_CASE("a line goes on behind a backslash, if lines may, but for one within a remark") {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    CHECK(lines_of("f 1\\" + end + "2" + end + "v", LineJoin::backslash) == List{"1 f 1\\" + end + "2", "3 v"});
    CHECK(words_of("f 1\\" + end + "2 \\" + end + " 3") == List{"f", "1", "2", "3"});
  }
  CHECK(lines_of("# C:\\\nv", LineJoin::backslash) == List{"1 # C:\\", "2 v"});
  CHECK(lines_of("a\\", LineJoin::backslash) == List{"1 a\\"});
  CHECK(lines_of("a\\\nb") == List{"1 a\\", "2 b"});
  LineWords words("1 \\\n \\\n x", 7);
  words.next();
  CHECK_THROWS_WITH_AS(words.number(), "line 9: found 'x', expected a number", core::InputError);
}

TEST_CASE("a byte that no text has is refused with its line") {
  CHECK_THROWS_WITH_AS(lines_of(std::string_view("a\nb\0c", 5)),
                       "line 2: expected text, found byte 0; write the file anew, as text", core::InputError);
  CHECK_THROWS_AS(lines_of("\x7f"), core::InputError);
  CHECK_THROWS_AS(lines_of("\x1a\x1a"), core::InputError);
  CHECK(lines_of("v # \x01\x7f\nw") == List{"1 v # \x01\x7f", "2 w"});
  CHECK_THROWS_AS(lines_of("# a\nv \x01"), core::InputError);
  CHECK(lines_of("\t\v\f \xe4\xff") == List{"1 \t\v\f \xe4\xff"});
}

TEST_CASE("words are parted by blanks, and a remark is none") {
  CHECK(words_of(" \tf  1\t2 # 3") == List{"f", "1", "2"});
  CHECK(words_of("1#2") == List{"1"});
  CHECK(words_of("-1.#IND 1.5#") == List{"-1.#IND", "1.5"});
  CHECK(words_of("# a").empty());
  CHECK(words_of(" \v\f").empty());
  LineWords words("map_Kd  my #1 wood.png \t", 1);
  words.next();
  CHECK(words.rest_of_line() == "my #1 wood.png");
  CHECK(without_remark("my #1 wood.png") == "my");
  CHECK(without_remark("a#1.png") == "a#1.png");
  CHECK(without_remark("#").empty());
}

TEST_CASE("a decimal number is all of a word, and nothing else is a number") {
  CHECK(decimal_number(".9") == 0.9);
  CHECK(decimal_number("+1") == 1);
  CHECK(decimal_number("1.") == 1);
  CHECK(decimal_number("-1e5") == -1e5);
  CHECK(decimal_number("5412345.25") == 5412345.25);
  CHECK(decimal_number("1e-999") == 0);
  CHECK(decimal_number("-0") == 0);
  for (const char* word :
       {"", "+", "-", ".", "+-1", "--1", "1x", "10.0D-01", "-1.#IND", "nan", "-inf", "0x10", "1e999", "1,5", "1e"}) {
    CAPTURE(word);
    CHECK_FALSE(decimal_number(word).has_value());
  }
}

TEST_CASE("what is no number is refused with the line, and so is what follows") {
  CHECK_THROWS_WITH_AS(LineWords("1x", 12).number(), "line 12: found '1x', expected a number", core::InputError);
  CHECK_THROWS_WITH_AS(LineWords(" # 1", 12).number(), "line 12: found the end of the line, expected a number", core::InputError);
  CHECK(LineWords("+7", 1).integer() == 7);
  CHECK_THROWS_WITH_AS(LineWords("7.5", 2).integer(), "line 2: found '7.5', expected a whole number", core::InputError);
  CHECK_THROWS_AS(LineWords("9223372036854775808", 2).integer(), core::InputError);
  LineWords(" # x", 1).expect_end();
  CHECK_THROWS_WITH_AS(LineWords("x", 3).expect_end(), "line 3: found 'x', expected the end of the line", core::InputError);
}

}  // namespace dmpc::apps::line_words_test
