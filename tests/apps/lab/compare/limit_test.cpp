#include "apps/lab/compare/limit.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "core/base/expect.h"

namespace dmpc::apps::limit_test {

namespace {

std::vector<std::string> passed(const std::string& limit, const PictureError& error) {
  return passed_limits({parse_limit(limit)}, error);
}

}  // namespace

TEST_CASE("a limit holds up to its number, itself included") {
  CHECK(passed("max:0.25", {.largest = 0.25}).empty());
  CHECK(passed("max:0.25", {.largest = 0.26}) == std::vector<std::string>{"max 0.26 is above 0.25"});
  CHECK(passed("max:0", {}).empty());
}

TEST_CASE("each measure is judged by its own figure, and a fraction is told as it was typed") {
  const PictureError error{.root_mean_square = 1,
                           .largest = 2,
                           .percentile_99 = 3,
                           .mean_absolute = 4,
                           .relative_mean_square = 5,
                           .flip_mean = 6,
                           .flip_percentile_99 = 7,
                           .differing_pixels = 8};
  int value = 0;
  for (const std::string name : {"rmse", "max", "p99", "mae", "relmse", "flip", "flip-p99", "pixels"}) {
    CHECK(passed(name + ":1/255", error) == std::vector<std::string>{name + " " + std::to_string(++value) + " is above 1/255"});
  }
}

TEST_CASE("what is infinite or no number is above any limit") {
  constexpr double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  CHECK(passed("rmse:1e300", {.root_mean_square = infinite}).size() == 1);
  CHECK(passed("rmse:1e300", {.root_mean_square = none}).size() == 1);
}

}  // namespace dmpc::apps::limit_test
