// How a picture is used as a texture.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/expect.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// Use of a texture's alpha: it has no meaning; it has one but is not shown, which is reported; or it counts.
enum class TextureAlpha : std::uint8_t { ignored, said, kept };

/// How a texture continues beyond its edges, along each side, and how its alpha is used.
struct TextureEdges {
  core::TextureWrap s = core::TextureWrap::repeat, t = core::TextureWrap::repeat;
  TextureAlpha alpha = TextureAlpha::ignored;
  double cutoff = 0;  ///< alpha below this is cut out, up to 1; 0: nothing is cut out
  /// For a smooth coat over these colours: the share of white light that it reflects inwards, up to coat_max.
  double coat = 0;
};
inline constexpr double coat_max = 0.99;

/// Returns the part of a channel that comes out through such a coat.
constexpr double below_coat(double channel, double coat) { return channel * (1 - coat) / (1 - channel * coat); }
/// Applies below_coat() to all texels of `texture`, which has no smaller levels yet.
void put_below_coat(core::Texture& texture, double coat);

/// Throws core::InputError "NAME: ..." for a texture that has no texels, or more than core::Texture::size_max along a side.
inline void check_texture_size(const std::string& name, std::int64_t width, std::int64_t height) {
  constexpr std::int64_t most = core::Texture::size_max;
  if (width < 1 || height < 1 || width > most || height > most) {
    throw core::InputError(name + ": a texture of " + std::to_string(width) + "x" + std::to_string(height) +
                           " texels; expected 1 to " + std::to_string(most) + " along a side");
  }
}

}  // namespace dmpc::apps
