#include "core/record/coordinate.h"

#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/random.h"

namespace coordinate_test {

using namespace dmpc::core;
using dmpc::apps::Random;

TEST_CASE("coordinates are multiples of one step, the nearest ones, and so are their differences") {
  Random random(1);
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.between(-1, 1) * std::ldexp(1.0, -static_cast<int>(random.below(80)));
    const double coordinate{coordinate_of(value)}, steps = coordinate / coordinate_step;
    REQUIRE(steps == std::floor(steps));
    REQUIRE(std::fabs(coordinate - value) <= std::max(0.5 * coordinate_step, 0x1p-24 * std::fabs(value)));
  }
  CHECK(coordinate_of(1e-40) == 0.0F);
  CHECK(coordinate_of(-1e-17) == 0.0F);
}

TEST_CASE("away from zero a coordinate is the nearest float") {
  for (const double value : {0.1, -1.0 / 3, 1e-6, -1e-9, 12345.678, 1e30}) {
    CHECK(coordinate_of(value) == static_cast<float>(value));
  }
}

}  // namespace coordinate_test
