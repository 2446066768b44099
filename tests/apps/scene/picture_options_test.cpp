#include "apps/scene/picture_options.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"

namespace dmpc::apps {

using core::UsageError;

TEST_CASE("a resolution is two numbers with an x between them") {
  CHECK(parse_resolution("1x1").width == 1);
  CHECK(parse_resolution("640x480").height == 480);
  CHECK(parse_resolution("65536x4096").width == 65536);
  for (const char* text : {"", "x", "5", "5x", "x5", "0x5", "5x0", "-5x5", "5x5x5", "5X5", "5 x5", "65537x1", "65536x65536"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_resolution(text), UsageError);
  }
}

}  // namespace dmpc::apps
