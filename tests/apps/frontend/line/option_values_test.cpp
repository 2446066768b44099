#include "apps/frontend/line/option_values.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::apps::option_values_test {

using core::UsageError;
using core::operator""_MiB;

TEST_CASE("a share is a number above 0 and at most 1, or a fraction that is") {
  CHECK(parse_share("0.25", "--x") == 0.25);
  CHECK(parse_share("4e-3", "--x") == 0.004);
  CHECK(parse_share("1/255", "--x") == 1.0 / 255);
  CHECK(parse_share("1.5/2", "--x") == 0.75);
  CHECK(parse_share("1", "--x") == 1);
  CHECK(parse_share("0", "--x", true) == 0);
  for (const char* text :
       {"", "/", "1/", "/2", "0", "-0.1", "1.1", "2/1", "1/0", "0/0", "1/2/3", "nan", "inf", "1/inf", "0.1x", " 1"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_share(text, "--x"), UsageError);
  }
  for (const char* text : {"", "-0.1", "1.1", "0/0", "nan", "1e-400/x"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_share(text, "--x", true), UsageError);
  }
}

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

TEST_CASE("a size beyond the most is refused by saying what that is") {
  for (const char* text : {"1025GiB", "99999999999999999999", "18446744073709551615GiB"}) {
    CHECK_THROWS_WITH_AS(parse_size_bytes(text, "--x"), doctest::Contains("expected at most 1024GiB"), UsageError);
  }
  CHECK_THROWS_WITH_AS(parse_size_bytes("99999999999999999999MB", "--x"), doctest::Contains("a size such as"), UsageError);
}

TEST_CASE("a seed is any whole number of 64 bits") {
  CHECK(parse_seed("0", "--x") == 0);
  CHECK(parse_seed("18446744073709551615", "--x") == ~std::uint64_t{0});
  for (const char* text : {"", "-1", "18446744073709551616", "storm", "1.5", "7x", " 7"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_seed(text, "--x"), UsageError);
  }
}

TEST_CASE("numbers are whole, from 1 to the most that there may be, with commas between") {
  CHECK(parse_numbers("4", "--x", 8) == std::vector<std::uint32_t>{4});
  CHECK(parse_numbers("8,1,8", "--x", 8) == std::vector<std::uint32_t>{8, 1, 8});
  CHECK(parse_different_numbers("8,1,3,8", "--x", 8) == std::vector<std::uint32_t>{1, 3, 8});
  for (const char* text : {"", ",", "0", "9", "-1", "1,", ",1", "1,,2", "1.5", "1 ,2", "99999999999"}) {
    CAPTURE(std::string(text));
    CHECK_THROWS_AS(parse_numbers(text, "--x", 8), UsageError);
  }
}

}  // namespace dmpc::apps::option_values_test
