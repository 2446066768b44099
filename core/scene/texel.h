// Texels: colours in 32 bits.
#pragma once

#include <cstdint>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Linear light. Exact arithmetic of its own, so the same on every machine.
Color decoded(TexelFormat format, std::uint32_t texel);

/// The texel nearest to `color`; what is negative or no number counts as 0, what is too large as the largest: 1 for srgb and
/// fine_srgb, 65,408 for shared_exponent, whose error is up to 1/512 of the largest channel. srgb and fine_srgb: nearest on the
/// curve's scale.
std::uint32_t encoded(TexelFormat format, const Vec3d& color);

}  // namespace dmpc::core
