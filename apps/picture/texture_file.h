// Textures from picture files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/scene/texture.h"

namespace dmpc::apps {

/// What becomes of a texture's alpha: it means nothing, it means something that is not shown, and is said, or it counts.
enum class TextureAlpha : std::uint8_t { ignored, said, kept };

/// How a texture goes on beyond its edges, along each side, and what its alpha does.
struct TextureEdges {
  core::TextureWrap s = core::TextureWrap::repeat, t = core::TextureWrap::repeat;
  TextureAlpha alpha = TextureAlpha::ignored;
  double cutoff = 0;  ///< of alpha that cuts out what is less, up to 1; 0: it cuts nothing out
  /// Of a smooth coat over what has these colours: what it sends back inwards of the light of white, up to coat_max.
  double coat = 0;
};
inline constexpr double coat_max = 0.99;

/// What comes out through such a coat of a channel.
constexpr double below_coat(double channel, double coat) { return channel * (1 - coat) / (1 - channel * coat); }
/// That for all texels of `texture`, which has no smaller levels yet.
void put_below_coat(core::Texture& texture, double coat);

/// Reads the first three channels (one or two: the first is taken thrice) of the first picture in the file, and makes its smaller
/// levels. Alpha is left out, and the colours are as they are without it; where it counts, and some of it is not 1, texels have 8
/// bits a channel with it (core::TexelFormat::srgb_alpha). Integers are taken as sRGB, whatever the file says of gamma or
/// profiles: 8 bits are kept, more are stored as fine_srgb. Floats are linear, and stored with a shared exponent. Throws
/// core::InputError if there is no such picture, if it is larger than core::Texture::size_max along a side or than any database,
/// has no texels, several layers, or several samples a texel.
core::Texture read_texture(const std::filesystem::path& path, const TextureEdges& edges);

/// Reads a file that lies in memory, as in a scene's own file; `name` is for messages, `format_hint` an extension such as
/// "png" or "jpg", or nothing if that is not known.
core::Texture read_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                           const TextureEdges& edges);

}  // namespace dmpc::apps
