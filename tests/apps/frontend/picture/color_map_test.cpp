#include "apps/frontend/picture/color_map.h"

#include <doctest/doctest.h>

#include <limits>

namespace dmpc::apps::picture_color_map_test {

TEST_CASE("positions beyond the ends are the ends, and what is no number the lower one") {
  CHECK(color_map(-1) == color_map(0));
  CHECK(color_map(2) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::infinity()) == color_map(1));
  CHECK(color_map(std::numeric_limits<double>::quiet_NaN()) == color_map(0));
}

}  // namespace dmpc::apps::picture_color_map_test
