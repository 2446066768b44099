#include "apps/picture/picture_format.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::apps::picture_format_test {

TEST_CASE("a picture's format is told by what it begins with, whatever it is called") {
  CHECK(picture_format("\x89PNG\r\n\x1a\n....", "jpg") == "png");
  CHECK(picture_format("\xff\xd8\xff\xe0", "") == "jpeg");
  CHECK(picture_format("RIFF....WEBPVP8 ", "png") == "webp");
  CHECK(picture_format("any bytes", "TGA") == "targa");
}

TEST_CASE("what begins otherwise is no picture that is read") {
  CHECK_FALSE(picture_format("FOR4....CIMG", "iff"));
  CHECK_FALSE(picture_format("RIFF....AVI ", "avi"));
  CHECK_FALSE(picture_format("", "png"));
  CHECK_FALSE(picture_format("RIFF", "webp"));
}

TEST_CASE("a small file may become a large picture, but not any") {
  CHECK(decoded_bytes(8192, 8192, 1) <= decoded_bytes_max(100));
  CHECK(decoded_bytes(30000, 30000, 4) > decoded_bytes_max(373));
}

}  // namespace dmpc::apps::picture_format_test
