#include "apps/frontend/line/number_text.h"

#include <doctest/doctest.h>

namespace dmpc::apps::number_text_test {

TEST_CASE("large numbers are grouped by threes") {
  CHECK(grouped(0) == "0");
  CHECK(grouped(999) == "999");
  CHECK(grouped(1000) == "1,000");
  CHECK(grouped(1234567) == "1,234,567");
}

TEST_CASE("a real number is written so that it reads back, or to six digits") {
  CHECK(shortest(0.1) == "0.1");
  CHECK(shortest(-2) == "-2");
  CHECK(shortest(1.0 / 3) == "0.3333333333333333");
  CHECK(shortest(1e300) == "1e+300");
  CHECK(rounded(1.0 / 3) == "0.333333");
  CHECK(rounded(12) == "12");
}

TEST_CASE("seconds have fewer digits the more they are") {
  CHECK(seconds_text(0) == "0.000 s");
  CHECK(seconds_text(3.14159) == "3.142 s");
  CHECK(seconds_text(31.4159) == "31.4 s");
}

TEST_CASE("bytes are rounded to the unit that suits them") {
  CHECK(bytes_text(0) == "0 B");
  CHECK(bytes_text(1023) == "1023 B");
  CHECK(bytes_text(1536) == "1.5 KiB");
  CHECK(bytes_text(std::size_t{3} << 20U) == "3.00 MiB");
}

TEST_CASE("a share of nothing is nothing") {
  CHECK(percent_text(percent_of(0, 0), 2) == "0.00 %");
  CHECK(percent_text(percent_of(1, 3), 2) == "33.33 %");
  CHECK(percent_text(percent_of(7, 7)) == "100.0 %");
}

TEST_CASE("parts in percent add up to a hundred as they stand") {
  const auto percent = [](std::vector<std::uint64_t> parts) { return percent_parts(parts); };
  CHECK(percent({1, 1, 1}) == std::vector<double>{33.3, 33.4, 33.3});
  CHECK(percent({0, 7}) == std::vector<double>{0, 100});
  CHECK(percent({0, 0}) == std::vector<double>{0, 0});
  CHECK(percent({}).empty());
}

TEST_CASE("one thing stands in the singular") {
  CHECK(counted(0, "ray") == "0 rays");
  CHECK(counted(1, "ray") == "1 ray");
  CHECK(counted(2000, "ray") == "2,000 rays");
}

TEST_CASE("numbers are short") {
  CHECK(legend_number(0) == "0");
  CHECK(legend_number(12) == "12");
  CHECK(legend_number(0.03512345) == "0.03512");
  CHECK(legend_number(1500000) == "1.5e+06");
}

}  // namespace dmpc::apps::number_text_test
