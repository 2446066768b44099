#include "apps/frontend/line/scale.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps::scale_test {

using Numbers = std::vector<double>;

TEST_CASE("a linear scale goes from the least to the largest") {
  const NumberScale scale = scale_for(Numbers{3, 7, 5});
  CHECK_FALSE(scale.is_logarithmic);
  CHECK(scale.position(3) == 0);
  CHECK(scale.position(5) == 0.5);
  CHECK(scale.position(7) == 1);
  CHECK(scale.position(1) == 0);
  CHECK(scale.position(9) == 1);
}

TEST_CASE("a few numbers far above the others make a scale logarithmic, which leaves 0 out") {
  const NumberScale scale = scale_for(Numbers{0, 0, 1, 2, 4, 1024});
  CHECK(scale.is_logarithmic);
  CHECK(scale.least == 1);
  CHECK(scale.position(1) == 0);
  CHECK(scale.position(32) == doctest::Approx(0.5));
  CHECK(scale.position(1024) == 1);
  CHECK_FALSE(scale_for(Numbers{0, 0, 0, 512, 1024}).is_logarithmic);
}

TEST_CASE("equal numbers all stand at the beginning of their scale") {
  for (const double value : {0.0, 4.0}) {
    const NumberScale scale = scale_for(Numbers{value, value});
    CHECK(scale.position(value) == 0);
    CHECK(scale.ticks() == Numbers{value});
  }
}

TEST_CASE("a scale needs a number, and none below 0 or without end") {
  CHECK_THROWS_AS(scale_for(Numbers{}), core::InternalError);
  CHECK_THROWS_AS(scale_for(Numbers{1, -1}), core::InternalError);
  CHECK_THROWS_AS(scale_for(Numbers{1, 1e308 * 10}), core::InternalError);
}

TEST_CASE("ticks are round numbers within the scale") {
  CHECK(NumberScale{false, 0, 10}.ticks() == Numbers{0, 2, 4, 6, 8, 10});
  CHECK(NumberScale{false, 3, 27}.ticks() == Numbers{5, 10, 15, 20, 25});
  CHECK(NumberScale{true, 1, 100}.ticks() == Numbers{1, 2, 5, 10, 20, 50, 100});
  CHECK(NumberScale{true, 3, 7000}.ticks() == Numbers{10, 100, 1000});
  const Numbers small = NumberScale{false, 0, 0.3}.ticks();
  CHECK(small.size() == 7);
  CHECK(small.back() == doctest::Approx(0.3));
}

}  // namespace dmpc::apps::scale_test
