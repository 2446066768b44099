#include "apps/frontend/table/averages.h"

#include <doctest/doctest.h>

#include <vector>

#include "core/base/expect.h"

namespace dmpc::tests::averages_test {

using apps::geometric_mean;
using apps::median;

TEST_CASE("a geometric mean is that of factors") {
  CHECK(*geometric_mean(std::vector{0.5, 2.0}) == doctest::Approx(1));
  CHECK(*geometric_mean(std::vector{1.0, 10.0, 100.0}) == doctest::Approx(10));
  CHECK_FALSE(geometric_mean({}));
}

TEST_CASE("a median is the number in the middle or the mean of two") {
  CHECK(median({3}) == 3);
  CHECK(median({9, 1, 2}) == 2);
  CHECK(median({4, 1, 9, 2}) == 3);
  CHECK_THROWS_AS(median({}), core::InternalError);
}

}  // namespace dmpc::tests::averages_test
