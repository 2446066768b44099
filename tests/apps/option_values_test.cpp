#include "apps/option_values.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/expect.h"
#include "core/units.h"

namespace dmpc::apps {

using core::UsageError;
using core::operator""_MiB;

TEST_CASE("a size is a whole number with a binary unit") {
  CHECK(parse_size_bytes("0", "--x") == 0);
  CHECK(parse_size_bytes("300", "--x") == 300);
  CHECK(parse_size_bytes("300B", "--x") == 300);
  CHECK(parse_size_bytes("3KiB", "--x") == 3072);
  CHECK(parse_size_bytes("4MiB", "--x") == 4_MiB);
  CHECK(parse_size_bytes("1024GiB", "--x") == std::size_t{1} << 40U);
  for (const char* text :
       {"", "MiB", "-1", "1.5MiB", "4MB", "4mib", "4 MiB", "1025GiB", "99999999999999999999", "0x10", "1KiBx"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_size_bytes(text, "--x"), UsageError);
  }
}

TEST_CASE("a seed is any whole number of 64 bits") {
  CHECK(parse_seed("0", "--x") == 0);
  CHECK(parse_seed("18446744073709551615", "--x") == ~std::uint64_t{0});
  for (const char* text : {"", "-1", "18446744073709551616", "storm", "1.5", "7x", " 7"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_seed(text, "--x"), UsageError);
  }
}

}  // namespace dmpc::apps
