#include "apps/lab/study/systems/price_draws.h"

#include <doctest/doctest.h>

namespace dmpc::tests::price_draws_test {

namespace {

using apps::ahead_in;
using apps::first_in;

/// So many draws, all with these times.
std::vector<std::vector<double>> draws(std::size_t count, const std::vector<double>& seconds) { return {count, seconds}; }

}  // namespace

TEST_CASE("a clear winner is ahead in 100 of 100 draws, and equal times are nobody's") {
  CHECK(ahead_in(draws(100, {1, 2, 3}), 0, 1).count == 100);
  CHECK(first_in(draws(100, {1, 2, 3})) == std::vector<std::uint32_t>{100, 0, 0});
  CHECK(ahead_in(draws(100, {1, 1}), 0, 1).count == 0);
  CHECK(ahead_in(draws(100, {1, 1}), 0, 1).is_undecided());
  CHECK(first_in(draws(100, {1, 1})) == std::vector<std::uint32_t>{0, 0});
  CHECK(ahead_in({{1, 2}, {2, 1}, {1, 2}}, 0, 1).count == 2);
  CHECK(first_in({}).empty());
}

}  // namespace dmpc::tests::price_draws_test
