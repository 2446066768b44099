#include "core/base/box.h"

#include <doctest/doctest.h>

#include "apps/lab/bench/stability/random.h"

namespace bounds_test {

using namespace dmpc::core;

TEST_CASE("rounding brings a number no farther than to the next float") {
  CHECK(rounded_down(1.0) == 1.0F);
  CHECK(rounded_up(1.0) == 1.0F);
  CHECK(rounded_down(1.0 + 1e-12) == 1.0F);
  CHECK(rounded_up(1.0 + 1e-12) == std::nextafter(1.0F, 2.0F));
  CHECK(rounded_down(-1.0 - 1e-12) == std::nextafter(-1.0F, -2.0F));
}

TEST_CASE("rounded bounds hold their box") {
  dmpc::apps::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Box box;
    box.include(random.in_box(-1, 1));
    box.include(random.in_box(-1, 1));
    const Bounds bounds = Bounds::around(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(double{bounds.low[axis]} <= box.low[axis]);
      CHECK(double{bounds.high[axis]} >= box.high[axis]);
    }
  }
}

TEST_CASE("bounds grow, are cut off, and know their surface") {
  Bounds bounds = Bounds::around({{0, 0, 0}, {1, 1, 1}});
  bounds.include(Bounds::around({{2, 0, -1}, {3, 1, 0}}));
  CHECK(bounds.low == std::array<float, 4>{0, 0, -1, 0});
  CHECK(bounds.high == std::array<float, 4>{3, 1, 1, 0});
  CHECK(bounds.area() == 3.0F + 2.0F + 6.0F);
  CHECK(bounds.middle(0) == 3.0F);
  const Bounds part = bounds.clamped_to(Bounds::around({{1, 1, 1}, {2, 2, 2}}));
  CHECK(part.low == std::array<float, 4>{1, 1, 1, 0});
  CHECK(part.high == std::array<float, 4>{2, 1, 1, 0});
}

}  // namespace bounds_test
