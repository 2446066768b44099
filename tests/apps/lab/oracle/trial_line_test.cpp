#include "apps/lab/oracle/trial_line.h"

#include <doctest/doctest.h>

namespace dmpc::tests::trial_line_test {

TEST_CASE("a trial says in one line what was tried, what failed, the worst and where") {
  const apps::Trial::Counts tried = {{1200, "ray"}, {0, "certificate"}, {1, "place"}};
  CHECK(apps::line_of({.tried = tried, .failed = {{0, "ray"}}}) ==
        "Tried: 1,200 rays, 1 place. Failed: nothing. Worst: nothing was off.");
  CHECK(apps::line_of({.tried = tried, .failed = {{1, "ray"}, {2, "place"}}, .worst = "3 pixels off", .where = "pixel (1, 2)"}) ==
        "Tried: 1,200 rays, 1 place. Failed: 1 ray, 2 places. Worst: 3 pixels off, in pixel (1, 2).");
}

}  // namespace dmpc::tests::trial_line_test
