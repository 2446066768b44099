#include "apps/frontend/table/rounds.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <sstream>
#include <vector>

namespace dmpc::tests::rounds_test {

TEST_CASE("every round visits all settings before the next begins") {
  std::ostringstream output;
  apps::Progress progress(output, false);
  std::vector<std::size_t> visits;
  apps::round_by_round(2, 3, progress, [&](std::size_t index) { visits.push_back(index); });
  CHECK(visits == std::vector<std::size_t>{0, 1, 2, 0, 1, 2});
}

TEST_CASE("without rounds or settings nothing is visited") {
  std::ostringstream output;
  apps::Progress progress(output, false);
  const auto fail = [](std::size_t) { FAIL_CHECK("visited"); };
  apps::round_by_round(0, 3, progress, fail);
  apps::round_by_round(3, 0, progress, fail);
}

}  // namespace dmpc::tests::rounds_test
