#include "apps/frontend/system/digest.h"

#include <doctest/doctest.h>

#include <string_view>

namespace dmpc::apps::digest_test {

namespace {

std::uint64_t digest_of(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.value();
}

}  // namespace

TEST_CASE("equal texts have equal digests") { CHECK(digest_of("a long enough text") == digest_of("a long enough text")); }

TEST_CASE("a digest tells texts apart by every character, by their length and by their order") {
  CHECK(digest_of("a long enough text") != digest_of("a long enough tex"));
  CHECK(digest_of("a long enough text") != digest_of("a long enough texu"));
  CHECK(digest_of("a long enough text") != digest_of("b long enough text"));
  CHECK(digest_of("01234567abcdefgh") != digest_of("abcdefgh01234567"));
  CHECK(digest_of("") != digest_of(std::string_view("\0", 1)));
}

TEST_CASE("a digest tells numbers apart by their bits") {
  Digest zero, minus_zero;
  zero.add(0.0);
  minus_zero.add(-0.0);
  CHECK(zero.value() != minus_zero.value());
}

}  // namespace dmpc::apps::digest_test
