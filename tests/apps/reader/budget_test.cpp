#include "apps/reader/budget.h"

#include <doctest/doctest.h>

#include <chrono>

namespace dmpc::tests::budget_test {

using namespace std::chrono_literals;

TEST_CASE("bytes alone renew what reading may take") {
  apps::ReadingBudget budget({.seconds = 10, .bytes_a_second = 1000, .wall_factor = 3});
  CHECK(budget.left() == 10s);
  CHECK(budget.wall_left() == 30s);
  budget.spend(7500ms);
  budget.wait(29s);
  CHECK(budget.left() == 2500ms);
  CHECK(budget.wall_left() == 1s);
  budget.add_bytes(500);
  budget.add_bytes(499);
  CHECK(budget.left() == 2500ms);
  budget.add_bytes(1);
  CHECK(budget.seconds() == 11);
  CHECK(budget.left() == 3500ms);
  budget.spend(4s);
  CHECK(budget.left() < 0s);
}

}  // namespace dmpc::tests::budget_test
