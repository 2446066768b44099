#include "apps/lab/difference/picture_error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "apps/lab/bench/stability/random.h"
#include "core/base/expect.h"
#include "tests/support/gray.h"

namespace dmpc::tests::flip_test {

using apps::flip;
using apps::Image;
using apps::Random;

namespace {

Image one_color(float red, float green, float blue) {
  Image image(24, 24);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    image.rgb[i] = red;
    image.rgb[i + 1] = green;
    image.rgb[i + 2] = blue;
  }
  return image;
}

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Image noise(std::uint64_t seed, float share) {
  Random random(seed);
  Image image = gray(32, 32, 0.5F);
  for (float& value : image.rgb) {
    value += share * (static_cast<float>(random.below(1000)) / 500 - 1);
  }
  return image;
}

}  // namespace

TEST_CASE("equal pictures differ nowhere") {
  const std::vector<float> same = flip(noise(1, 0.4F), noise(1, 0.4F));
  CHECK(same.size() == 32 * 32);
  CHECK(*std::max_element(same.begin(), same.end()) == 0);
  CHECK(flip(Image(0, 0), Image(0, 0)).empty());
}

TEST_CASE("green and blue, the farthest apart of all colours, differ by 1") {
  for (const float value : flip(one_color(0, 1, 0), one_color(0, 0, 1))) {
    CHECK(value == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("black and white differ by 100 in lightness alone, which is 0.967 of the scale") {
  // 100^0.7 = 25.12 between 0.4 of 41.3, where 0.95 is reached, and 41.3
  for (const float value : flip(gray(20, 20, 0), gray(20, 20, 1))) {
    CHECK(value == doctest::Approx(0.9676).epsilon(1e-3));
  }
}

TEST_CASE("the difference is the same both ways") {
  const Image a = noise(1, 0.2F), b = noise(2, 0.2F);
  CHECK(flip(a, b) == flip(b, a));
}

TEST_CASE("a difference grows with its size, and fine noise counts less when it is finer to the eye") {
  const Image still = gray(32, 32, 0.5F);
  CHECK(mean(flip(noise(3, 0.05F), still)) < mean(flip(noise(3, 0.4F), still)));
  CHECK(mean(flip(noise(3, 0.2F), still, 200)) < mean(flip(noise(3, 0.2F), still, 20)));
}

TEST_CASE("a bright point on black is perceived around it and nowhere else") {
  Image point = gray(65, 65, 0);
  std::fill_n(point.rgb.begin() + 3 * (32 * 65 + 32), 3, 1.0F);
  const std::vector<float> seen = flip(point, gray(65, 65, 0));
  CHECK(seen[32 * 65 + 32] > 0.1);
  CHECK(seen[32 * 65 + 30] < seen[32 * 65 + 32]);
  CHECK(seen[0] == 0);
  CHECK(seen[32 * 65 + 30] == doctest::Approx(seen[32 * 65 + 34]));
  CHECK(seen[32 * 65 + 30] == doctest::Approx(seen[30 * 65 + 32]));
}

TEST_CASE("values beyond what a screen shows count as the nearest that it does, and no number as black") {
  CHECK(flip(gray(4, 4, 7), gray(4, 4, 1)) == flip(gray(4, 4, 1), gray(4, 4, 1)));
  CHECK(flip(gray(4, 4, -2), gray(4, 4, std::numeric_limits<float>::quiet_NaN())) == flip(gray(4, 4, 0), gray(4, 4, 0)));
}

TEST_CASE("pictures of different sizes are refused") { CHECK_THROWS_AS(flip(gray(2, 3, 0), gray(3, 2, 0)), core::InternalError); }

}  // namespace dmpc::tests::flip_test
