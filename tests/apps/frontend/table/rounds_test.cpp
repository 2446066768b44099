#include "apps/frontend/table/rounds.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace dmpc::tests::rounds_test {

TEST_CASE("every round visits all settings before the next begins") {
  std::vector<std::pair<std::size_t, std::size_t>> visits;
  apps::round_by_round(2, 3, [&](std::size_t round, std::size_t index) { visits.emplace_back(round, index); });
  CHECK(visits == std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}});
}

TEST_CASE("without rounds or settings nothing is visited") {
  const auto fail = [](std::size_t, std::size_t) { FAIL_CHECK("visited"); };
  apps::round_by_round(0, 3, fail);
  apps::round_by_round(3, 0, fail);
}

}  // namespace dmpc::tests::rounds_test
