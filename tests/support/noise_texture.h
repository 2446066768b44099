// A texture whose every texel has a colour of its own.
#pragma once

#include <cstdint>

#include "core/base/sampling.h"
#include "core/scene/texture.h"

namespace dmpc::tests {

/// Deterministic noise, with its smaller levels.
inline core::Texture noise_texture(std::uint32_t width, std::uint32_t height,
                                   core::TextureWrap wrap_s = core::TextureWrap::repeat,
                                   core::TextureWrap wrap_t = core::TextureWrap::repeat,
                                   core::TexelFormat format = core::TexelFormat::srgb) {
  core::Texture texture{.name = "noise", .format = format, .wrap_s = wrap_s, .wrap_t = wrap_t, .levels = {{width, height, {}}}};
  const std::uint32_t bits = format == core::TexelFormat::srgb ? 0xffffffU : 0x7fffffffU;  // half of the exponents
  for (std::uint32_t texel = 0; texel < width * height; ++texel) {
    texture.levels.front().texels.push_back(static_cast<std::uint32_t>(core::mix(texel + 1)) & bits);
  }
  core::add_levels(texture);
  return texture;
}

}  // namespace dmpc::tests
