// Texels: colours in 32 bits.
#pragma once

#include <bit>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Linear light, or linear numbers. Exact arithmetic of its own, so the same on every machine.
Color decoded(TexelFormat format, std::uint32_t texel);

/// The sum of the channels of decoded(TexelFormat::shared_exponent, texel), exact.
inline double sum_of_channels(std::uint32_t texel) {
  constexpr std::uint32_t channel_mask = 511;
  constexpr std::uint64_t bias = 1023 - 15 - 9, mantissa_bits = 52;
  const std::uint32_t sum = (texel & channel_mask) + (texel >> 9U & channel_mask) + (texel >> 18U & channel_mask);
  return sum * std::bit_cast<double>((std::uint64_t{texel >> 27U} + bias) << mantissa_bits);
}

/// Alpha of a texel, from 0 to 1; 1 if the format has none.
float alpha_of(TexelFormat format, std::uint32_t texel);

/// The texel nearest to `color`, with the alpha nearest to `alpha` if the format has one; negative values and NaN count as 0, too
/// large ones as the maximum: 1, except for shared_exponent 65,408, whose error is up to 1/512 of the largest channel. With the
/// curve: nearest on its scale.
std::uint32_t encoded(TexelFormat format, const Vec3d& color, double alpha = 1);

}  // namespace dmpc::core
