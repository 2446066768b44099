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
  double brightest = 0;  ///< maximum over all channels of all texels
  Color darkest;         ///< each channel's minimum over all texels: for TexelFormat::linear only
  std::vector<TextureLevel> levels;
};

/// Adds the smaller levels to `texture`, which has its finest, and finds the brightest channel. A texel is the mean, in linear
/// light, of what it covers of the next finer level, whose texels are weighted by their covered shares, where a side is odd, and
/// by their alpha.
void add_levels(Texture& texture);

/// For a cutoff of alpha, up to 1, means of holes and leaves would be all holes, or none, from some distance on. So the alpha of
/// each level except the finest is scaled until the same share of its texels reaches the cutoff, as nearly as possible; a level
/// for which that holds already is left as it is (I. Castano, "Computing Alpha Mipmaps", 2010, who finds the scale by bisection;
/// here by counting). Nothing changes for a cutoff of 0, or a format without alpha.
void keep_coverage(Texture& texture, double cutoff);

}  // namespace dmpc::core
