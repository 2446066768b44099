#include "apps/lab/bench/stability/counts.h"

#include <doctest/doctest.h>

namespace dmpc::tests::counts_test {

using apps::failure_rate_bound;
using apps::StabilityCounts;

TEST_CASE("no failure in a billion tries bounds the rate at three in a billion") {
  CHECK(failure_rate_bound(0, 1'000'000'000) == doctest::Approx(3e-9));
}

TEST_CASE("the bound with failures is the chi-squared distribution's within 1 %") {
  CHECK(failure_rate_bound(1, 1000) == doctest::Approx(4.7439e-3).epsilon(0.01));
  CHECK(failure_rate_bound(10, 100'000) == doctest::Approx(16.962e-5).epsilon(0.01));
  CHECK(failure_rate_bound(100, 1'000'000) == doctest::Approx(118.08e-6).epsilon(0.01));
}

TEST_CASE("no bound of a rate exceeds 1") {
  CHECK(failure_rate_bound(0, 1) == 1);
  CHECK(failure_rate_bound(7, 7) == 1);
}

TEST_CASE("each way to fail is a failure and what rounding explains is none") {
  CHECK(StabilityCounts{.tried = 9, .leaks = 1, .wrong_hits = 2, .double_claims = 3, .unexplained = 4}.failures() == 10);
  CHECK(StabilityCounts{.tried = 9, .explained = 5, .error_milliulp = 500}.failures() == 0);
}

TEST_CASE("sums keep the worst error and add the rest, in any order") {
  const StabilityCounts a{1, 2, 3, 4, 5, 6, 700}, b{10, 20, 30, 40, 50, 60, 70};
  StabilityCounts forward = a, backward = b;
  forward += b;
  backward += a;
  CHECK(forward == StabilityCounts{11, 22, 33, 44, 55, 66, 700});
  CHECK(forward == backward);
}

}  // namespace dmpc::tests::counts_test
