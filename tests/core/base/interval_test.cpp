#include "core/base/interval.h"

#include <doctest/doctest.h>

#include "apps/lab/bench/stability/random.h"

namespace interval_test {

using namespace dmpc::core;

namespace {

constexpr double last_place = 0x1p-52;

TEST_CASE("what is exact in double has no width") {
  CHECK((Interval(1.5) + Interval(0.25)).width() == 0);
  CHECK((Interval(3) - Interval(3)).most() == 0);
  CHECK((Interval(1.5) * Interval(-0.75)).width() == 0);
}

TEST_CASE("what is rounded lies between two neighbours, on the side where it is") {
  const Interval sum = Interval(1) + Interval(0x1p-60), product = Interval(1 + last_place) * Interval(1 + last_place);
  CHECK(sum.low == 1);
  CHECK(sum.high > 1);
  CHECK(sum.high <= 1 + 2 * last_place);
  CHECK(product.low == 1 + 2 * last_place);  // and 2^-104
  CHECK(product.high > product.low);
  const Interval third = Interval(1) / Interval(3);
  CHECK(third.low < 1.0 / 3);
  CHECK(third.high > 1.0 / 3);
  CHECK((third * Interval(3)).holds(1));
}

TEST_CASE("products take the ends that are farthest apart") {
  const Interval product = Interval(-1, 2) * Interval(-3, 5);
  CHECK(product.low == -6);
  CHECK(product.high == 10);
  CHECK(magnitude(Interval(-3, 2)).low == 0);
  CHECK(magnitude(Interval(-3, 2)).high == 3);
  CHECK(magnitude(Interval(-3, -2)).low == 2);
}

TEST_CASE("of what is divided by 0, or overflows, nothing is known") {
  CHECK_FALSE((Interval(1) / Interval(-1, 1)).is_bounded());
  CHECK_FALSE((Interval(1) / Interval(0)).is_bounded());
  CHECK_FALSE((Interval(1e300) * Interval(1e300)).is_bounded());
  CHECK((Interval::everything() * Interval(0)).holds(1e300));
}

TEST_CASE("products that underflow keep a width") {
  const Interval tiny = Interval(0x1p-600) * Interval(0x1.8p-600);
  CHECK(tiny.low <= 0);
  CHECK(tiny.high > 0);
}

TEST_CASE("an interval holds what doubles make of any numbers in its operands") {
  dmpc::apps::Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const double a = random.between(-1, 1), b = random.between(-1, 1), from_a = a - random.unit(), to_b = b + random.unit();
    const Interval left(from_a, a), right(b, to_b);
    CHECK((left + right).holds(a + b));
    CHECK((left * right).holds(from_a * to_b));
    CHECK((left - right).holds(a - to_b));
  }
}

}  // namespace

}  // namespace interval_test
