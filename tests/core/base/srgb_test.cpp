#include "core/base/srgb.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace dmpc::core::srgb_test {

namespace {

/// The curve's other direction, by libm.
double encoded_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("the sRGB curve keeps black and white and clamps what lies outside") {
  CHECK(linear_from_srgb(0) == 0);
  CHECK(linear_from_srgb(1) == 1);
  CHECK(linear_from_srgb(-0.5) == 0);
  CHECK(linear_from_srgb(2) == 1);
  CHECK(linear_from_srgb(std::numeric_limits<double>::quiet_NaN()) == 0);
}

TEST_CASE("the sRGB curve agrees with its definition to a few roundings") {
  for (int step = 1; step < 1000; ++step) {
    const double encoded = step / 1000.0;
    const double defined = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    CHECK(linear_from_srgb(encoded) == doctest::Approx(defined).epsilon(1e-14));
  }
}

TEST_CASE("every byte survives becoming linear and a byte again") {
  for (int byte = 0; byte < 256; ++byte) {
    CHECK(srgb_byte(static_cast<float>(linear_from_srgb(byte / 255.0))) == byte);
  }
}

TEST_CASE("a linear value becomes the nearest byte of its encoded value") {
  for (int step = 0; step < 5000; ++step) {
    const float linear = static_cast<float>(step) / 4999.0F;
    CHECK(srgb_byte(linear) == std::lround(255 * encoded_from_linear(static_cast<double>(linear))));
  }
}

TEST_CASE("the next byte begins just above the value half-way to it") {
  for (int byte = 0; byte < 255; ++byte) {
    const double limit = linear_from_srgb((byte + 0.5) / 255);
    auto below = static_cast<float>(limit);
    while (static_cast<double>(below) > limit) {
      below = std::nextafter(below, 0.0F);
    }
    CHECK(srgb_byte(below) == byte);
    CHECK(srgb_byte(std::nextafter(below, 1.0F)) == byte + 1);
  }
  CHECK(srgb_byte(std::numeric_limits<float>::denorm_min()) == 0);
}

TEST_CASE("bytes are clamped and NaN is black") {
  CHECK(srgb_byte(-1) == 0);
  CHECK(srgb_byte(7.5F) == 255);
  CHECK(srgb_byte(std::numeric_limits<float>::infinity()) == 255);
  CHECK(srgb_byte(std::numeric_limits<float>::quiet_NaN()) == 0);
}

}  // namespace dmpc::core::srgb_test
