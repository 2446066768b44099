// A texture on the host: a picture and its smaller copies, before it is cut into tiles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Texels row by row from the top left.
struct TextureLevel {
  std::uint32_t width = 1, height = 1;
  std::vector<std::uint32_t> texels;
};

/// Finest level first, the last is a single texel.
struct Texture {
  static constexpr std::uint32_t size_max = 65535;  ///< along a side

  std::string name;  ///< the file's, for messages
  TexelFormat format{};
  TextureWrap wrap_s{}, wrap_t{};
  double brightest = 0;  ///< of all channels of all texels
  Color darkest;         ///< each channel's least of all texels: of TexelFormat::linear alone
  std::vector<TextureLevel> levels;
};

/// Adds the smaller levels to `texture`, which has its finest, and finds the brightest channel. A texel is the mean, in linear
/// light, of what it covers of the level above, whose texels count by the shares of them that it covers where a side is odd, and
/// by their alpha.
void add_levels(Texture& texture);

}  // namespace dmpc::core
