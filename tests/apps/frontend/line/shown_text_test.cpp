#include "apps/frontend/line/shown_text.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace dmpc::apps::shown_text_test {

TEST_CASE("what steers a terminal is shown, and not obeyed") {
  CHECK(shown("a\x1b[31mb") == "a\\x1b[31mb");
  CHECK(shown(std::string("\0\r\b\x7f", 4)) == "\\x00\\x0d\\x08\\x7f");
  CHECK(shown("\xC2\x9b") == "\\u009b");
  CHECK(shown("evil\xE2\x80\xAEgnp.exe") == "evil\\u202egnp.exe");
  CHECK(shown("\xE2\x81\xA6x\xE2\x81\xA9\xE2\x80\x8F\xD8\x9C\xE2\x80\xA8") == "\\u2066x\\u2069\\u200f\\u061c\\u2028");
}

TEST_CASE("what is no UTF-8 is shown byte by byte") {
  CHECK(shown("\x9b") == "\\x9b");
  CHECK(shown("\xC3(") == "\\xc3(");
  CHECK(shown("\xE2\x80") == "\\xe2\\x80");
  CHECK(shown("\xC0\x9b\xED\xA0\x80\xF5") == "\\xc0\\x9b\\xed\\xa0\\x80\\xf5");
}

TEST_CASE("all other text stays, with its lines and tabs") {
  for (const std::string text : {"", "tea pot.nff", "a\tb\nc", "Größe, 茶壺, \xF0\x9F\xAB\x96, שלום"}) {
    CHECK(shown(text) == text);
  }
}

TEST_CASE("a character that comes in pieces stays one") {
  std::ostringstream stream;
  {
    const ShownOutput output(stream);
    for (const char byte : std::string("茶\x1b\xE8\x8C")) {
      stream << byte << std::flush;
    }
    stream << "\xB6" << std::string("\xE8");
  }
  CHECK(stream.str() == "茶\\x1b茶\\xe8");
}

TEST_CASE("progress may clear its line where names may not") {
  std::ostringstream stream;
  clear_line(stream);
  CHECK(stream.str() == "\r\x1b[K");
  stream.str("");
  {
    const ShownOutput output(stream);
    stream << "\xE8" << clear_line << "\r";
  }
  CHECK(stream.str() == "\\xe8\r\x1b[K\\x0d");
}

TEST_CASE("a stream that takes no more is bad through it, too") {
  struct Full : std::streambuf {
  } full;
  std::ostream refusing(&full);
  {
    const ShownOutput output(refusing);
    refusing << "text";
  }
  CHECK_FALSE(refusing.good());
}

TEST_CASE("a text of strangers becomes a part of a line of a length that one can read") {
  CHECK(apps::clipped("plain") == "plain");
  CHECK(apps::clipped("a\x1b[31m\nb") == "a\\x1b[31m b");
  CHECK(apps::clipped(std::string(1000, 'x'), 10) == "xxxxxxxxxx ... (1000 bytes)");
  CHECK(apps::clipped("\xc3\xa4\xc3\xa4", 3) == "\xc3\xa4\\xc3 ... (4 bytes)");
}

TEST_CASE("a word longer than any path leaves the rest of a message to be read") {
  CHECK(apps::with_words_clipped("plain words\n  of two lines") == "plain words\n  of two lines");
  const std::string path(4000, 'p'), word(100'000, 'w');
  CHECK(apps::with_words_clipped(path + ": is no scene") == path + ": is no scene");
  CHECK(apps::with_words_clipped("no " + word + " here") == "no " + word.substr(0, 200) + "...(100000 bytes) here");
}

}  // namespace dmpc::apps::shown_text_test
