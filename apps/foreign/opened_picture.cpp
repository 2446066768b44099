#include "apps/foreign/opened_picture.h"

#include "core/base/srgb.h"
#include "core/base/vec.h"
#include "core/scene/texel.h"

namespace dmpc::apps {
namespace {

using Byte = std::uint8_t;

constexpr int channels_max = 3;

/// One channel is taken thrice, of two the first.
int channels_of(const PictureForm& form) { return form.channels < channels_max ? 1 : channels_max; }

/// Calls take(values of three channels) for each of the pixels that have `count` each.
template <class T, class Take>
void for_each_texel(const std::vector<T>& values, int count, const Take& take) {
  const std::size_t green = count == channels_max ? 1 : 0, blue = 2 * green;
  for (std::size_t first = 0; first < values.size(); first += static_cast<std::size_t>(count)) {
    take(values[first], values[first + green], values[first + blue]);
  }
}

void add_bytes(const OpenedPicture& opened, int count, std::vector<std::uint32_t>& texels) {
  for_each_texel(opened.bytes(count), count, [&](Byte red, Byte green, Byte blue) {
    texels.push_back(std::uint32_t{red} | std::uint32_t{green} << 8U | std::uint32_t{blue} << 16U);
  });
}

void add_floats(const OpenedPicture& opened, int count, core::TexelFormat format, std::vector<std::uint32_t>& texels) {
  const auto light = [is_srgb = format == core::TexelFormat::fine_srgb](float value) {
    return is_srgb ? core::linear_from_srgb(double{value}) : double{value};
  };
  for_each_texel(opened.floats(count), count, [&](float red, float green, float blue) {
    texels.push_back(core::encoded(format, {light(red), light(green), light(blue)}));
  });
}

/// Adds the file's alpha to a texture, unless it is 1 everywhere. The colours are as read without alpha, except for EXR, where
/// they are multiplied by it.
void add_alpha(const std::vector<Byte>& alpha, bool is_multiplied, core::Texture& texture) {
  if (alpha.empty()) {
    return;
  }
  std::vector<std::uint32_t>& texels = texture.levels.front().texels;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const double share = alpha[i] / 255.0, multiplied = is_multiplied && share > 0 ? share : 1;
    const core::Vec3d color = core::Vec3d(core::decoded(texture.format, texels[i])) * (1 / multiplied);
    texels[i] = core::encoded(core::TexelFormat::srgb_alpha, color, share);
  }
  texture.format = core::TexelFormat::srgb_alpha;
}

void make_linear(std::vector<float>& values) {
  for (float& value : values) {
    value = static_cast<float>(core::linear_from_srgb(static_cast<double>(value)));
  }
}

std::vector<float> spread(const std::vector<float>& gray) {
  std::vector<float> rgb;
  rgb.reserve(gray.size() * channels_max);
  for (const float value : gray) {
    rgb.insert(rgb.end(), channels_max, value);
  }
  return rgb;
}

}  // namespace

core::Texture texture_of(const OpenedPicture& opened, const EncodedPicture& picture) {
  const PictureForm form = opened.form();
  core::Texture texture{.name = picture.name, .format = form.format, .levels = {{form.width, form.height, {}}}};
  texture.levels.front().texels.reserve(std::size_t{form.width} * form.height);
  if (form.format == core::TexelFormat::srgb) {
    add_bytes(opened, channels_of(form), texture.levels.front().texels);
  } else {
    add_floats(opened, channels_of(form), form.format, texture.levels.front().texels);
  }
  if (picture.alpha == TextureAlpha::kept) {
    add_alpha(opened.alpha(), picture.format == "openexr", texture);
  }
  return texture;
}

Image image_of(const OpenedPicture& opened) {
  const PictureForm form = opened.form();
  const int count = channels_of(form);
  std::vector<float> values = opened.floats(count);
  if (form.format != core::TexelFormat::shared_exponent) {
    make_linear(values);
  }
  Image image;
  image.width = static_cast<int>(form.width);
  image.height = static_cast<int>(form.height);
  image.rgb = count == 1 ? spread(values) : std::move(values);
  return image;
}

}  // namespace dmpc::apps
