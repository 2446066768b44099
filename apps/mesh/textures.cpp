#include "apps/mesh/textures.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <span>
#include <system_error>
#include <utility>

#include "core/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

core::TextureWrap wrap_of(aiTextureMapMode mode) {
  return mode == aiTextureMapMode_Mirror                                    ? core::TextureWrap::mirror
         : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? core::TextureWrap::clamp
                                                                            : core::TextureWrap::repeat;
}

std::optional<TextureUse> texture_of(const aiMaterial& source, aiTextureType type) {
  aiString path;
  aiTextureMapping mapping = aiTextureMapping_UV;
  std::array<aiTextureMapMode, 2> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  TextureUse use;
  const bool has_one = source.GetTextureCount(type) > 0 && source.GetTexture(type, 0, &path, &mapping, &use.coordinates, nullptr,
                                                                             nullptr, modes.data()) == aiReturn_SUCCESS;
  if (!has_one || mapping != aiTextureMapping_UV || path.length == 0) {
    return std::nullopt;
  }
  use.path = path.C_Str();
  use.edges = {wrap_of(modes[0]), wrap_of(modes[1])};
  return use;
}

/// "%20" as a blank: glTF names files by addresses.
std::string decoded_address(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned letter = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_coded =
        text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, letter, 16).ptr == digits + 2;
    decoded += is_coded ? static_cast<char>(letter) : text[i];
    i += is_coded ? 2 : 0;
  }
  return decoded;
}

/// The file that a mesh file at `mesh` names: as it stands, decoded, or, where neither exists, by its last part beside the mesh.
fs::path resolved(const fs::path& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path folder = mesh.parent_path(), plain = folder / name;
  std::error_code error;
  for (const fs::path& candidate : {plain, folder / decoded_address(name), folder / fs::path(name).filename()}) {
    if (fs::is_regular_file(candidate, error)) {
      return candidate;
    }
  }
  return plain;
}

/// Texels that the file holds ready, as bytes.
core::Texture from_texels(const aiTexture& source, const std::string& name, const TextureEdges& edges) {
  check_texture_size(name, source.pcData == nullptr ? 0 : source.mWidth, source.mHeight);
  core::Texture texture{.name = name, .wrap_s = edges.s, .wrap_t = edges.t, .levels = {{source.mWidth, source.mHeight, {}}}};
  const std::size_t count = std::size_t{source.mWidth} * source.mHeight;
  for (const aiTexel& texel : std::span(source.pcData, count)) {
    texture.levels.front().texels.push_back(std::uint32_t{texel.r} | std::uint32_t{texel.g} << 8U |
                                            std::uint32_t{texel.b} << 16U);
  }
  core::add_levels(texture);
  return texture;
}

}  // namespace

std::optional<TextureUse> colour_texture(const aiMaterial& source) {
  const auto base = texture_of(source, aiTextureType_BASE_COLOR);
  return base ? base : texture_of(source, aiTextureType_DIFFUSE);
}

core::Texture TextureReader::read(const TextureUse& use) const {
  const aiTexture* const within = file_.GetEmbeddedTexture(use.path.c_str());
  if (within == nullptr) {
    return read_texture(resolved(path_, use.path), use.edges);
  }
  const std::string name = path_.string() + ", texture " + use.path;
  if (within->mHeight > 0) {
    return from_texels(*within, name, use.edges);
  }
  const auto* const bytes = reinterpret_cast<const std::byte*>(within->pcData);
  return read_texture({bytes, within->mWidth}, name, within->achFormatHint, use.edges);
}

std::optional<std::uint32_t> TextureReader::find(const TextureUse& use) {
  const std::string key =
      use.path + '\n' + std::to_string(static_cast<int>(use.edges.s)) + std::to_string(static_cast<int>(use.edges.t));
  const auto [known, is_new] = known_.try_emplace(key);
  if (is_new) {
    try {
      textures_.push_back(read(use));
      known->second = static_cast<std::uint32_t>(textures_.size() - 1);
    } catch (const core::InputError& error) {
      missing_.insert(error.what());
    }
  }
  return known->second;
}

}  // namespace dmpc::apps
