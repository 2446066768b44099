#include "core/picture/surfaces/texture_footprint.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace dmpc::core::texture_footprint_test {

namespace {

/// A right triangle whose legs are the sides of a texture of 64 by 32 texels.
TexturedNormals half_of_texture() { return {.texture = {.width = 64, .height = 32}, .place = {{{0, 0}, {1, 0}, {0, 1}}}}; }

/// Across its axes these shares of the first and of the second leg.
CutEllipse along_legs(float first, float second) { return {{{{first, 0}, {0, second}}}}; }

/// On the texture.
struct Rectangle {
  TexturePlace low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

  void include(const std::array<float, 2>& place) {
    low = {std::min(low.s, double{place[0]}), std::min(low.t, double{place[1]})};
    high = {std::max(high.s, double{place[0]}), std::max(high.t, double{place[1]})};
  }
  bool has(double s, double t) const {
    constexpr double rounding = 0x1p-30;  // core/database/shading/texture_records.cpp takes 2^-20 more
    return s >= low.s - rounding && s <= high.s + rounding && t >= low.t - rounding && t <= high.t + rounding;
  }
};

double texels_of(const TexturePlace& stride) { return std::hypot(stride.s * 64, stride.t * 32); }

}  // namespace

TEST_CASE("what is seen straight on has one probe, as wide as the cone") {
  const TextureFootprint footprint = footprint_of(half_of_texture(), 0.25, 0.5, along_legs(4.0F / 64, 4.0F / 32), 1);
  CHECK(footprint.middle.s == doctest::Approx(0.25));
  CHECK(footprint.middle.t == doctest::Approx(0.5));
  CHECK(footprint.width == doctest::Approx(4));
  CHECK(footprint.strides == doctest::Approx(1));
}

TEST_CASE("a wider cone covers more, in proportion") {
  const TextureFootprint narrow = footprint_of(half_of_texture(), 0.25, 0.5, along_legs(8.0F / 64, 4.0F / 32), 0.5);
  const TextureFootprint wide = footprint_of(half_of_texture(), 0.25, 0.5, along_legs(8.0F / 64, 4.0F / 32), 1);
  CHECK(narrow.width == doctest::Approx(2));
  CHECK(wide.width == doctest::Approx(4));
  CHECK(wide.strides == doctest::Approx(narrow.strides));
}

TEST_CASE("what is longer than wide has probes along the longer axis, as wide as the shorter one") {
  const TextureFootprint flat = footprint_of(half_of_texture(), 0.3, 0.4, along_legs(20.0F / 64, 4.0F / 32), 1);
  CHECK(flat.width == doctest::Approx(4));
  CHECK(flat.strides == doctest::Approx(5));
  CHECK(flat.stride.s == doctest::Approx(4.0 / 64));
  CHECK(flat.stride.t == doctest::Approx(0));
  const TextureFootprint steep = footprint_of(half_of_texture(), 0.3, 0.4, along_legs(2.0F / 64, 6.0F / 32), 1);
  CHECK(steep.width == doctest::Approx(2));
  CHECK(steep.strides == doctest::Approx(3));
  CHECK(steep.stride.s == doctest::Approx(0));
  CHECK(std::fabs(steep.stride.t) == doctest::Approx(2.0 / 32));
}

TEST_CASE("axes that a slanted texture bends towards each other have the width of their ellipse") {
  // The unit circle under ((4 4) (0 1)), in texels: its singular values.
  const CutEllipse bent{{{{4.0F / 64, 0}, {4.0F / 64, 1.0F / 32}}}};
  const TextureFootprint footprint = footprint_of(half_of_texture(), 0.3, 0.4, bent, 1);
  const double longer = std::sqrt((33 + std::sqrt(33.0 * 33 - 64)) / 2), shorter = 4 / longer;
  CHECK(footprint.width == doctest::Approx(shorter).epsilon(1e-6));
  CHECK(footprint.strides == doctest::Approx(longer).epsilon(1e-6));  // of a texel each, since that is more
  CHECK(texels_of(footprint.stride) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("what is very long has as many probes as there may be, and wider ones") {
  const TextureFootprint footprint = footprint_of(half_of_texture(), 0.5, 0.4, along_legs(45.0F / 64, 1.0F / 32), 1);
  CHECK(footprint.strides == doctest::Approx(probes_max));
  CHECK(footprint.width == doctest::Approx(3));
}

TEST_CASE("the middles of probes keep to the rectangle of the triangle's corners, however wide the cone") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(0, 1), exponent(-20, 60);
  std::uniform_real_distribution<float> change(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    TexturedNormals triangle{.texture = {.width = 64, .height = 32}};
    Rectangle box;
    for (auto& place : triangle.place) {
      place = {3 * change(random), change(random)};
      box.include(place);
    }
    const double u = share(random), v = share(random) * (1 - u);
    const CutEllipse ellipse{{{{change(random), change(random)}, {change(random), change(random)}}}};
    const TextureFootprint footprint = footprint_of(triangle, u, v, ellipse, std::exp2(exponent(random)));
    const double reach = (footprint.strides - 1) / 2;
    REQUIRE(std::isfinite(footprint.width));
    for (const double side : {-reach, reach}) {
      REQUIRE(box.has(footprint.middle.s + side * footprint.stride.s, footprint.middle.t + side * footprint.stride.t));
    }
  }
}

TEST_CASE("a cone that grows makes no jump where the number of probes changes") {
  TextureFootprint before = footprint_of(half_of_texture(), 0.3, 0.4, along_legs(0.2F, 0.03F), 0.01);
  for (double cone = 0.01; cone < 30; cone *= 1.001) {
    const TextureFootprint now = footprint_of(half_of_texture(), 0.3, 0.4, along_legs(0.2F, 0.03F), cone);
    REQUIRE(std::fabs(now.strides - before.strides) < 0.02);
    REQUIRE(std::fabs(now.width - before.width) <= 0.002 * now.width);
    REQUIRE(texels_of({now.middle.s - before.middle.s, now.middle.t - before.middle.t}) < 0.1);
    before = now;
  }
}

TEST_CASE("no cone and no ellipse are a point") {
  for (const TextureFootprint& footprint :
       {footprint_of(half_of_texture(), 0.3, 0.4, {}, 1), footprint_of(half_of_texture(), 0.3, 0.4, along_legs(1, 1), 0)}) {
    CHECK(footprint.width == 0);
    CHECK(footprint.strides == 1);
    CHECK(footprint.middle.s == doctest::Approx(0.3));
  }
}

}  // namespace dmpc::core::texture_footprint_test
