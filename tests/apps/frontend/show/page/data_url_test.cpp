#include "apps/frontend/show/page/data_url.h"

#include <doctest/doctest.h>

namespace dmpc::apps::html::data_url_test {

TEST_CASE("bytes are written as RFC 4648 has them") {
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string_view("\xFF\x00\xFB", 3)) == "/wD7");
}

TEST_CASE("an address with its own bytes names their type") { CHECK(data_url("text/csv", "foo") == "data:text/csv;base64,Zm9v"); }

}  // namespace dmpc::apps::html::data_url_test
