// What becomes of a picture that is read as a texture.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/expect.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// What becomes of a texture's alpha: it means nothing, it means something that is not shown, and is said, or it counts.
enum class TextureAlpha : std::uint8_t { ignored, said, kept };

/// How a texture goes on beyond its edges, along each side, and what its alpha does.
struct TextureEdges {
  core::TextureWrap s = core::TextureWrap::repeat, t = core::TextureWrap::repeat;
  TextureAlpha alpha = TextureAlpha::ignored;
  double cutoff = 0;  ///< alpha below this is cut out, up to 1; 0: nothing is cut out
  /// For a smooth coat over these colours: the share of white light that it reflects inwards, up to coat_max.
  double coat = 0;
};
inline constexpr double coat_max = 0.99;

/// What comes out through such a coat of a channel.
constexpr double below_coat(double channel, double coat) { return channel * (1 - coat) / (1 - channel * coat); }
/// That for all texels of `texture`, which has no smaller levels yet.
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
