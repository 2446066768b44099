#include "apps/formats/landscape/terrain.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace dmpc::apps::terrain_test {

using core::Vec3d;

TEST_CASE("the ground is a function of its place, the same on every machine") {
  CHECK(ground_height(0.5, -0.25) == ground_height(0.5, -0.25));
  CHECK(ground_height(0.5, -0.25) == 0x1.6977e4fcbb054p-3);
  CHECK(ground_height(-0.75, 0.125) == 0x1.f8bea948b53efp-4);
  CHECK(ground_height(0.5, -0.25) != ground_height(0.5, -0.2500001));
}

TEST_CASE("there are mountains, and a lake between them") {
  double low = 1, high = 0;
  for (int i = 0; i < 2000; ++i) {
    const double height = ground_height(i % 50 / 25.0 - 1, i / 50 / 40.0 - 0.5);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  CHECK(low >= 0);
  CHECK(low < lake_height);
  CHECK(high > 0.25);
  CHECK(high < 0.5);
  CHECK(ground_height(-0.1, 0.34) == 0);
}

TEST_CASE("the ground has no steps where the noise's lattice has its lines") {
  for (const double line : {-0.5, 0.0, 4.0 / 9, 0.5}) {
    CHECK(ground_height(line - 1e-9, 0.1) == doctest::Approx(ground_height(line + 1e-9, 0.1)).epsilon(1e-5));
    CHECK(ground_height(0.1, line - 1e-9) == doctest::Approx(ground_height(0.1, line + 1e-9)).epsilon(1e-5));
  }
}

TEST_CASE("normals point up and away from where the ground rises") {
  CHECK(ground_normal(-0.1, 0.34, 1e-3).y == doctest::Approx(1).epsilon(1e-3));
  const double step = 1.0 / 512;
  for (const double x : {-0.9, -0.3, 0.2, 0.8}) {
    const Vec3d normal = ground_normal(x, -0.3, step);
    CHECK(dot(normal, normal) == doctest::Approx(1));
    CHECK(normal.y > 0);
    CHECK((normal.x > 0) == (ground_height(x - step, -0.3) > ground_height(x + step, -0.3)));
    CHECK((normal.z > 0) == (ground_height(x, -0.3 - step) > ground_height(x, -0.3 + step)));
  }
}

TEST_CASE("flat ground is sand at the lake and snow up high, steep ground is rock") {
  const Vec3d sand = ground_color(0.3, 0.1, lake_height, 1), snow = ground_color(0.3, 0.1, 0.4, 1),
              rock = ground_color(0.3, 0.1, 0.4, 0.1);
  CHECK(sand.x > sand.z);
  CHECK(snow.z > 0.5);
  CHECK(rock.x < 0.3);
  for (const Vec3d& color : {sand, snow, rock}) {
    CHECK(std::min({color.x, color.y, color.z}) >= 0);
    CHECK(std::max({color.x, color.y, color.z}) <= 1.01);
  }
}

}  // namespace dmpc::apps::terrain_test
