#include "core/scene/texel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/srgb.h"

namespace dmpc::core {
namespace {

/// OpenGL's EXT_texture_shared_exponent: a channel is mantissa * 2^(exponent - 15 - 9).
constexpr int mantissa_bits = 9, exponent_bias = 15, exponent_max = 31;
constexpr double mantissa_max = (1U << mantissa_bits) - 1;

constexpr std::array<float, 256> curve() {
  std::array<float, 256> light{};
  for (std::size_t byte = 0; byte < light.size(); ++byte) {
    light[byte] = static_cast<float>(linear_from_srgb(static_cast<double>(byte) / 255));
  }
  return light;
}
constexpr std::array<float, 256> light_of_byte = curve();

/// fine_srgb: four steps for each step of a byte.
constexpr std::uint32_t fine_bits = 10, fine_mask = (1U << fine_bits) - 1, fine_steps = 4 * 255;

constexpr std::array<float, fine_mask + 1> fine_curve() {
  std::array<float, fine_mask + 1> light{};
  for (std::size_t step = 0; step < light.size(); ++step) {
    light[step] = static_cast<float>(linear_from_srgb(static_cast<double>(step) / fine_steps));
  }
  return light;
}
constexpr std::array<float, fine_mask + 1> light_of_step = fine_curve();

/// The linear value half-way, on the curve's scale, between each step and the next.
constexpr std::array<double, fine_steps> fine_limits() {
  std::array<double, fine_steps> limits{};
  for (std::size_t step = 0; step < limits.size(); ++step) {
    limits[step] = linear_from_srgb((static_cast<double>(step) + 0.5) / fine_steps);
  }
  return limits;
}

std::uint32_t encoded_fine(const Vec3d& color) {
  static constexpr std::array<double, fine_steps> limits = fine_limits();
  std::uint32_t texel = 0;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    const double light = color[channel] > 0 ? color[channel] : 0;
    const auto above = std::lower_bound(limits.begin(), limits.end(), light);
    texel |= static_cast<std::uint32_t>(above - limits.begin()) << channel * fine_bits;
  }
  return texel;
}

float mantissa(std::uint32_t texel, std::uint32_t channel) {
  return static_cast<float>(texel >> channel * mantissa_bits & ((1U << mantissa_bits) - 1));
}

/// The channel clamped to the format's range.
double bounded(double channel, double largest) { return channel > 0 ? std::min(channel, largest) : 0; }

std::uint32_t encoded_bytes(const Vec3d& color) {
  std::uint32_t texel = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    texel |= std::uint32_t{srgb_byte(static_cast<float>(color[channel]))} << 8 * channel;
  }
  return texel;
}

float share_of(std::uint32_t texel, std::uint32_t channel) { return static_cast<float>(texel >> channel * 8U & 0xffU) / 255.0F; }

std::uint32_t encoded_linear(const Vec3d& numbers) {
  std::uint32_t texel = 0;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    texel |= static_cast<std::uint32_t>(bounded(numbers[channel], 1) * 255 + 0.5) << 8 * channel;
  }
  return texel;
}

std::uint32_t encoded_exponent(const Vec3d& color) {
  const double largest_number = std::ldexp(mantissa_max, exponent_max - exponent_bias - mantissa_bits);
  Vec3d channels;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    channels[channel] = bounded(color[channel], largest_number);
  }
  const double largest = std::max({channels.x, channels.y, channels.z});
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest < 2^exponent
  exponent = largest > 0 ? std::max(exponent + exponent_bias, 0) : 0;
  const auto unit = [&] { return std::ldexp(1.0, exponent - exponent_bias - mantissa_bits); };
  exponent += std::floor(largest / unit() + 0.5) > mantissa_max ? 1 : 0;
  std::uint32_t texel = static_cast<std::uint32_t>(exponent) << 3 * mantissa_bits;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double steps = std::floor(channels[channel] / unit() + 0.5);
    texel |= static_cast<std::uint32_t>(steps) << channel * mantissa_bits;
  }
  return texel;
}

}  // namespace

Color decoded(TexelFormat format, std::uint32_t texel) {
  if (format == TexelFormat::srgb || format == TexelFormat::srgb_alpha) {
    return {light_of_byte[texel & 0xffU], light_of_byte[texel >> 8U & 0xffU], light_of_byte[texel >> 16U & 0xffU]};
  }
  if (format == TexelFormat::fine_srgb) {
    return {light_of_step[texel & fine_mask], light_of_step[texel >> fine_bits & fine_mask],
            light_of_step[texel >> 2 * fine_bits & fine_mask]};
  }
  if (format == TexelFormat::linear) {
    return {share_of(texel, 0), share_of(texel, 1), share_of(texel, 2)};
  }
  constexpr std::uint32_t float_bias = 127, float_mantissa_bits = 23;  // a power of 2 that is not denormal
  const auto unit =
      std::bit_cast<float>(((texel >> 3 * mantissa_bits) + float_bias - exponent_bias - mantissa_bits) << float_mantissa_bits);
  return Color{mantissa(texel, 0), mantissa(texel, 1), mantissa(texel, 2)} * unit;
}

float alpha_of(TexelFormat format, std::uint32_t texel) {
  return format == TexelFormat::srgb_alpha ? static_cast<float>(texel >> 24U) / 255.0F : 1.0F;
}

std::uint32_t encoded(TexelFormat format, const Vec3d& color, double alpha) {
  switch (format) {
    case TexelFormat::srgb:
      return encoded_bytes(color);
    case TexelFormat::fine_srgb:
      return encoded_fine(color);
    case TexelFormat::srgb_alpha:
      return encoded_bytes(color) | static_cast<std::uint32_t>(bounded(alpha, 1) * 255 + 0.5) << 24U;
    case TexelFormat::linear:
      return encoded_linear(color);
    case TexelFormat::shared_exponent:
      break;
  }
  return encoded_exponent(color);
}

}  // namespace dmpc::core
