#include "apps/texture_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <memory>
#include <vector>

#include "apps/scratch_folder.h"
#include "core/expect.h"
#include "core/record_writer.h"
#include "core/srgb.h"
#include "core/texel.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

constexpr int channels = 3;
/// Of the finest level: four bytes each, and a third of that for the other levels.
constexpr std::size_t texels_max = core::RecordWriter::bytes_max / 16 * 3;

std::size_t texel_count(const OIIO::ImageSpec& spec) {
  return static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
}

using Input = std::unique_ptr<OIIO::ImageInput>;

Input open(const fs::path& path, const std::string& name) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // else colours come multiplied by alpha
  Input input = OIIO::ImageInput::open(path.string(), &config);
  if (!input) {
    throw core::InputError(name + ": cannot be read as a picture: " + OIIO::geterror());
  }
  const OIIO::ImageSpec& spec = input->spec();
  check_texture_size(name, spec.width, spec.height);
  if (spec.depth > 1 || spec.deep) {
    throw core::InputError(name + ": a texture with " + (spec.deep ? "several samples a texel" : "several layers") +
                           "; expected a plain picture");
  }
  if (texel_count(spec) > texels_max) {
    throw core::InputError(name + ": a texture of " + std::to_string(texel_count(spec)) + " texels; expected at most " +
                           std::to_string(texels_max) + ", which fill a database: make it smaller");
  }
  return input;
}

/// Calls take(values of three channels) for each texel, row by row; integers come as 0 to 1.
template <class T, class Take>
void for_each_texel(OIIO::ImageInput& input, const std::string& name, OIIO::TypeDesc type, const Take& take) {
  const OIIO::ImageSpec& spec = input.spec();
  const int count = spec.nchannels < channels ? 1 : channels;
  std::vector<T> values(texel_count(spec) * static_cast<std::size_t>(count));
  if (!input.read_image(0, 0, 0, count, type, values.data())) {
    throw core::InputError(name + ": cannot be read: " + input.geterror());
  }
  const std::size_t green = count == channels ? 1 : 0, blue = 2 * green;
  for (std::size_t first = 0; first < values.size(); first += static_cast<std::size_t>(count)) {
    take(values[first], values[first + green], values[first + blue]);
  }
}

bool is_linear(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return spec.format.is_floating_point() || space == "Linear" || space == "linear" || space == "scene_linear";
}

void read_bytes(OIIO::ImageInput& input, const std::string& name, std::vector<std::uint32_t>& texels) {
  using Byte = std::uint8_t;
  for_each_texel<Byte>(input, name, OIIO::TypeDesc::UINT8, [&](Byte red, Byte green, Byte blue) {
    texels.push_back(std::uint32_t{red} | std::uint32_t{green} << 8U | std::uint32_t{blue} << 16U);
  });
}

void read_light(OIIO::ImageInput& input, const std::string& name, std::vector<std::uint32_t>& texels) {
  const bool linear = is_linear(input.spec());
  const auto light = [&](float value) { return linear ? double{value} : core::linear_from_srgb(double{value}); };
  for_each_texel<float>(input, name, OIIO::TypeDesc::FLOAT, [&](float red, float green, float blue) {
    texels.push_back(core::encoded(core::TexelFormat::shared_exponent, {light(red), light(green), light(blue)}));
  });
}

core::Texture read(const fs::path& path, const std::string& name, const TextureEdges& edges) {
  const Input input = open(path, name);
  const OIIO::ImageSpec& spec = input->spec();
  const bool keeps_bytes = spec.format == OIIO::TypeDesc::UINT8 && !is_linear(spec);
  core::Texture texture{.name = name,
                        .format = keeps_bytes ? core::TexelFormat::srgb : core::TexelFormat::shared_exponent,
                        .wrap_s = edges.s,
                        .wrap_t = edges.t,
                        .levels = {{static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}}}};
  texture.levels.front().texels.reserve(texel_count(spec));
  (keeps_bytes ? read_bytes : read_light)(*input, name, texture.levels.front().texels);
  core::add_levels(texture);
  return texture;
}

}  // namespace

void check_texture_size(const std::string& name, std::int64_t width, std::int64_t height) {
  constexpr std::int64_t most = core::Texture::size_max;
  if (width < 1 || height < 1 || width > most || height > most) {
    throw core::InputError(name + ": a texture of " + std::to_string(width) + "x" + std::to_string(height) +
                           " texels; expected 1 to " + std::to_string(most) + " along a side");
  }
}

core::Texture read_texture(const fs::path& path, const TextureEdges& edges) { return read(path, path.string(), edges); }

core::Texture read_texture(std::span<const std::byte> file, const std::string& name, const std::string& format_hint,
                           const TextureEdges& edges) {
  const ScratchFolder folder;  // not every format can be read from memory
  const fs::path path = folder / ("texture." + (format_hint.empty() ? std::string("png") : format_hint));
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  stream.close();
  if (!stream) {
    throw core::InputError(name + ": a copy of it cannot be written in " + path.parent_path().string());
  }
  return read(path, name, edges);
}

}  // namespace dmpc::apps
