#include "apps/lab/study/systems/too_small.h"

#include <doctest/doctest.h>

namespace dmpc::tests::too_small_test {

using apps::too_small;

TEST_CASE("a run that computes is large enough") {
  CHECK(too_small({.computing = 0.9, .film_wait = 0.05, .idle_at_end = 0.05, .host_busy = 0.2}, {128, 128, 1}).empty());
  CHECK(too_small({.computing = 0, .film_wait = 0.25, .idle_at_end = 0.25, .host_busy = 0.5}, {128, 128, 1}).empty());
}

TEST_CASE("where the film or the host decides, as many samples would do as make the rest as long") {
  CHECK(too_small({.computing = 0.2, .film_wait = 0.75, .host_busy = 0.1}, {128, 128, 4}) ==
        "nodes wait for film or are idle at the end for 75 % of the time: --samples=12 or more would do");
  CHECK(too_small({.computing = 0.5, .host_busy = 1}, {128, 128, 1}) ==
        "the host is busy for 100 % of the time: --samples=4 or more would do");
}

TEST_CASE("film and the end may decide together") {
  CHECK(too_small({.computing = 0.2, .film_wait = 0.5, .idle_at_end = 0.25}, {128, 128, 1}) ==
        "nodes wait for film or are idle at the end for 75 % of the time: --samples=3 or more would do");
}

TEST_CASE("where the end decides, a larger picture would do") {
  CHECK(too_small({.computing = 0.2, .idle_at_end = 0.8}, {128, 64, 1}) ==
        "nodes are idle at the end or wait for film for 80 % of the time: --resolution=256x128 or more would do");
}

}  // namespace dmpc::tests::too_small_test
