#include "core/database/conversion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "tests/support/small_scenes.h"

namespace conversion_test {

using namespace dmpc::core;

namespace {

/// More polygons than one thread takes at a time, each 7th of them degenerate, some with normals.
Scene many_polygons() {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 10'000; ++i) {
    const Vec3d a{i * 1.0, 0, 0}, b{i + 1.0, 0, 0}, c{i * 1.0, i % 7 == 0 ? 0.0 : 1.0, 0};
    if (i % 3 == 0) {
      builder.patch({a, b, c}, {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
    } else {
      builder.polygon({a, b, c});
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("a conversion is the same whatever the number of threads") {
  const Scene scene = many_polygons();
  const Conversion one = convert(scene, {}, Parallel(1)), many = convert(scene, {}, Parallel(8));
  REQUIRE(one.primitives.size() == many.primitives.size());
  CHECK(one.dropped == many.dropped);
  CHECK(std::equal(one.primitives.begin(), one.primitives.end(), many.primitives.begin(),
                   [](const PrimitiveValues& a, const PrimitiveValues& b) { return a.value == b.value; }));
  CHECK(std::equal(one.smooth.begin(), one.smooth.end(), many.smooth.begin(), many.smooth.end(),
                   [](const auto& a, const auto& b) { return a.primitive == b.primitive; }));
}

TEST_CASE("primitives keep the order of their objects, and smooth ones their numbers") {
  const Conversion all = convert(many_polygons(), {}, Parallel(2));
  CHECK(all.dropped == 1429);
  REQUIRE(all.primitives.size() == 10'000 - 1429);
  for (std::size_t id = 0; id < all.primitives.size(); ++id) {
    CHECK(all.primitives[id].value[0] == static_cast<float>(all.sources[id].object));
  }
  CHECK(std::all_of(all.smooth.begin(), all.smooth.end(),
                    [&](const auto& smooth) { return all.sources[smooth.primitive].object % 3 == 0; }));
}

TEST_CASE("the bounds of a scene hold what is finite in it") {
  Scene scene;
  SceneBuilder builder(scene);
  CHECK(bounds_of(scene, Parallel(1)).empty());
  builder.sphere({1, 2, 3}, -0.5);
  builder.sphere({1e300, 0, 0}, 1);
  builder.polygon({{0, 0, 0}, {4, 0, 0}, {0, 1, 0}});
  const Box box = bounds_of(scene, Parallel(2));
  CHECK(box.low == Vec3d{0, 0, 0});
  CHECK(box.high == Vec3d{4, 2.5, 3.5});
}

TEST_CASE("a vertex of which a number is none, or too large, bounds nothing, and those beside it do") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e30, -1e30}) {
    Scene scene;
    SceneBuilder builder(scene);
    builder.polygon({{0, 0, 0}, {4, 0, 0}, {0, 1, 0}});
    builder.polygon({{odd, 9, 9}, {-9, odd, 9}, {9, -9, odd}});
    builder.polygon({{0, 0, 0}, {0, 0, -2}, {0, 1, 0}});
    CAPTURE(odd);
    const Box box = bounds_of(scene, Parallel(1));
    CHECK(box.low == Vec3d{0, 0, -2});
    CHECK(box.high == Vec3d{4, 1, 0});
  }
}

}  // namespace conversion_test
