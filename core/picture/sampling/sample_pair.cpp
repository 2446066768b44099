#include "core/picture/sampling/sample_pair.h"

#include <cmath>

#include "core/base/elementary.h"
#include "core/base/sampling.h"

namespace dmpc::core {
namespace {

constexpr std::uint32_t reversed(std::uint32_t bits) {
  bits = (bits >> 16U) | (bits << 16U);
  bits = ((bits & 0xff00ff00U) >> 8U) | ((bits & 0x00ff00ffU) << 8U);
  bits = ((bits & 0xf0f0f0f0U) >> 4U) | ((bits & 0x0f0f0f0fU) << 4U);
  bits = ((bits & 0xccccccccU) >> 2U) | ((bits & 0x33333333U) << 2U);
  return ((bits & 0xaaaaaaaaU) >> 1U) | ((bits & 0x55555555U) << 1U);
}

/// A permutation in which each bit depends only on the seed and on lower bits (S. Laine, T. Karras, "Stratified Sampling for
/// Stochastic Transparency", 2011; constants: Burley, section 4).
constexpr std::uint32_t permuted(std::uint32_t value, std::uint32_t seed) {
  value += seed;
  value ^= value * 0x6c50b47cU;
  value ^= value * 0xb82f1e52U;
  value ^= value * 0xc7afe638U;
  return value ^ (value * 0x8d22f6e6U);
}

/// A. B. Owen's scrambling of the 32 digits of a number below 1, the first being the highest: each digit depends on those before
/// it.
constexpr std::uint32_t scrambled(std::uint32_t digits, std::uint32_t seed) { return reversed(permuted(reversed(digits), seed)); }

/// Sobol's second dimension with its digits reversed. Row i of the matrix is Pascal's triangle modulo 2, in which column j has a
/// 1 where the bits of i are among those of j (Lucas 1878): each bit of the result is the sum of the bits at positions that
/// contain its own position's bits, computed one position bit at a time.
constexpr std::uint32_t second_dimension_reversed(std::uint32_t index) {
  index ^= (index & 0xaaaaaaaaU) >> 1U;
  index ^= (index & 0xccccccccU) >> 2U;
  index ^= (index & 0xf0f0f0f0U) >> 4U;
  index ^= (index & 0xff00ff00U) >> 8U;
  return index ^ (index >> 16U);
}

double unit(std::uint32_t digits) { return static_cast<double>(digits) * 0x1p-32; }

constexpr double quarter_of_pi = 0.785398163397448310;

}  // namespace

SamplePair sample_pair(std::uint32_t pixel, std::uint32_t sample, std::uint32_t pair) {
  // Twice the number is kept for compatibility: pictures depend on it bit for bit.
  std::uint64_t seeds = mix((std::uint64_t{pixel} << 1U) + 0x9e3779b97f4a7c15ULL);
  if (pair > 0) {
    const std::uint64_t seed_of_order = mix(seeds + pair);
    sample = scrambled(sample, static_cast<std::uint32_t>(seed_of_order >> 32U));
    seeds = mix(seed_of_order + 0x9e3779b97f4a7c15ULL);
  }
  const auto seed_x = static_cast<std::uint32_t>(seeds), seed_y = static_cast<std::uint32_t>(seeds >> 32U);
  // The first dimension's digits are those of the index, reversed.
  return {unit(reversed(permuted(sample, seed_x))), unit(reversed(permuted(second_dimension_reversed(sample), seed_y)))};
}

DiscPlace on_disc(const SamplePair& pair) {
  const double a = 2.0 * pair.x - 1.0, b = 2.0 * pair.y - 1.0;
  const bool is_beside = std::fabs(a) > std::fabs(b);
  const double radius = is_beside ? a : b, ratio = radius == 0.0 ? 0.0 : (is_beside ? b : a) / radius;
  const double along = radius * cos_radians(quarter_of_pi * ratio), aside = radius * sin_radians(quarter_of_pi * ratio);
  return is_beside ? DiscPlace{along, aside, radius * radius} : DiscPlace{aside, along, radius * radius};
}

Vec3d about_axis(const Vec3d& axis, double x, double y, double along) {
  const double sign = std::copysign(1.0, axis.z), scale = -1.0 / (sign + axis.z), mixed = axis.x * axis.y * scale;
  const Vec3d first{1.0 + sign * axis.x * axis.x * scale, sign * mixed, -sign * axis.x};
  const Vec3d second{mixed, sign + axis.y * axis.y * scale, -axis.y};
  return first * x + second * y + axis * along;
}

}  // namespace dmpc::core
