#include "core/scene/texel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/base/srgb.h"

namespace dmpc::core::texel_test {

namespace {

constexpr auto srgb = TexelFormat::srgb;
constexpr auto shared_exponent = TexelFormat::shared_exponent;
constexpr auto fine_srgb = TexelFormat::fine_srgb;

void check_kept(TexelFormat format, std::uint32_t texel) {
  CAPTURE(texel);
  CHECK(encoded(format, Vec3d(decoded(format, texel))) == texel);
}

}  // namespace

TEST_CASE("the bytes of an sRGB texel are red, green and blue on the curve, and encoding gives them back") {
  CHECK(decoded(srgb, 0x000000) == Color{0, 0, 0});
  CHECK(decoded(srgb, 0xffffff) == Color{1, 1, 1});
  CHECK(decoded(srgb, 0x0000ff) == Color{1, 0, 0});
  CHECK(decoded(srgb, 0xff0000) == Color{0, 0, 1});
  CHECK(decoded(srgb, 0x008000).y == static_cast<float>(linear_from_srgb(128 / 255.0)));
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    check_kept(srgb, byte | (255 - byte) << 8U | (byte ^ 0x55U) << 16U);
  }
}

TEST_CASE("a texel of numbers is 255ths, without a curve, and encoding gives them back") {
  CHECK(decoded(TexelFormat::linear, 0x3300ff) == Color{1, 0, 51 / 255.0F});
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    check_kept(TexelFormat::linear, byte | (255 - byte) << 8U | (byte ^ 0x55U) << 16U);
  }
  CHECK(encoded(TexelFormat::linear, {-1, 2, std::numeric_limits<double>::quiet_NaN()}) == 0x00ff00);
}

TEST_CASE("a texel with a shared exponent is what OpenGL says") {
  CHECK(decoded(shared_exponent, 0) == Color{0, 0, 0});
  CHECK(decoded(shared_exponent, 256U | 16U << 27U) == Color{1, 0, 0});  // 256 / 512 * 2^(16 - 15)
  CHECK(decoded(shared_exponent, 511U << 18U | 31U << 27U) == Color{0, 0, 65408});
  CHECK(encoded(shared_exponent, {1, 0.5, 0.25}) == (256U | 128U << 9U | 64U << 18U | 16U << 27U));
  CHECK(encoded(shared_exponent, {65408, 0, 0}) == (511U | 31U << 27U));
}

TEST_CASE("a shared exponent errs by 1 in 512 of the largest channel, at most") {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    const auto channel = [&] { return std::exp2(static_cast<double>(random() % 2800) / 100 - 13); };
    const Vec3d color{channel(), channel(), channel()};
    const Vec3d off = Vec3d(decoded(shared_exponent, encoded(shared_exponent, color))) - color;
    const double largest = std::max({color.x, color.y, color.z});
    CHECK(std::max({std::fabs(off.x), std::fabs(off.y), std::fabs(off.z)}) <= largest / 512);
  }
}

TEST_CASE("a mantissa that rounds up to 512 goes on with the next exponent") {
  CHECK(decoded(shared_exponent, encoded(shared_exponent, {0.99999, 0, 0})) == Color{1, 0, 0});
}

TEST_CASE("a fine texel has every byte's colour, and steps a quarter as wide") {
  CHECK(decoded(fine_srgb, 0) == Color{0, 0, 0});
  CHECK(decoded(fine_srgb, 1020U << 20U) == Color{0, 0, 1});
  CHECK(decoded(fine_srgb, 4 * 128U << 10U).y == static_cast<float>(linear_from_srgb(128 / 255.0)));
  for (std::uint32_t step = 0; step <= 1020; ++step) {
    check_kept(fine_srgb, step | (1020 - step) << 10U | (step ^ 0x55U) % 1021 << 20U);
    const double light = linear_from_srgb((step + 0.3) / 1020);
    CHECK(encoded(fine_srgb, {light, 0, 0}) == std::min(step, 1020U));
  }
}

TEST_CASE("a fine texel is at least as near to any colour from 0 to 1 as one of bytes is") {
  for (std::uint32_t value = 0; value <= 65535; value += 7) {
    const double light = linear_from_srgb(value / 65535.0);
    const auto off = [&](TexelFormat format) {
      return std::fabs(static_cast<double>(decoded(format, encoded(format, {light, light, light})).x) - light);
    };
    CHECK(off(fine_srgb) <= off(srgb) + 1e-7);
  }
}

TEST_CASE("what no texel can hold is clamped") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const TexelFormat format : {srgb, shared_exponent, fine_srgb}) {
    CHECK(decoded(format, encoded(format, {-1, nan, -infinity})) == Color{0, 0, 0});
  }
  CHECK(decoded(srgb, encoded(srgb, {7, infinity, 1})) == Color{1, 1, 1});
  CHECK(decoded(fine_srgb, encoded(fine_srgb, {7, infinity, 1})) == Color{1, 1, 1});
  CHECK(decoded(fine_srgb, 0x3fffffff) == Color{1, 1, 1});
  CHECK(decoded(shared_exponent, encoded(shared_exponent, {1e9, infinity, 0})) == Color{65408, 65408, 0});
}

}  // namespace dmpc::core::texel_test
