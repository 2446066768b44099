#include "apps/foreign/mesh/textures.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "apps/formats/named_file.h"
#include "apps/picture/texture_size.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

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

std::string key_of(const TextureUse& use) {
  return use.path + '\n' + std::to_string(static_cast<int>(use.edges.s)) + std::to_string(static_cast<int>(use.edges.t)) +
         std::to_string(static_cast<int>(use.edges.alpha)) + ' ' + std::to_string(use.edges.cutoff);
}

/// Texels that the file holds ready.
std::vector<std::uint32_t> texels_of(const aiTexture& source, bool keeps_alpha) {
  std::vector<std::uint32_t> texels;
  for (const aiTexel& texel : std::span(source.pcData, std::size_t{source.mWidth} * source.mHeight)) {
    texels.push_back(std::uint32_t{texel.r} | std::uint32_t{texel.g} << 8U | std::uint32_t{texel.b} << 16U |
                     (keeps_alpha ? std::uint32_t{texel.a} << 24U : 0));
  }
  return texels;
}

}  // namespace

core::TextureWrap wrap_of(aiTextureMapMode mode) {
  return mode == aiTextureMapMode_Mirror                                    ? core::TextureWrap::mirror
         : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? core::TextureWrap::clamp
                                                                            : core::TextureWrap::repeat;
}

std::optional<TextureUse> colour_texture(const aiMaterial& source) {
  return texture_of(source, aiTextureType_BASE_COLOR);
}

std::string TextureReader::file_of(const std::string& name) {
  const fs::path folder = path_.parent_path();
  const std::vector<fs::path> files = files_.meant(folder, name);
  if (!files.empty() && is_under_other_name(folder, name, files.front())) {
    other_names_.insert(files.front().lexically_relative(folder.empty() ? fs::path(".") : folder).string() + " for " + name);
  }
  return (files.empty() ? folder / name : files.front()).string();
}

const MadePicture* TextureReader::made(const std::string& name) const {
  for (std::size_t i = 0; name.starts_with('*') && i < pictures_.size(); ++i) {
    if (name == "*" + std::to_string(i)) {
      return &pictures_[i];
    }
  }
  return nullptr;
}

void TextureReader::read(const TextureUse& use) {
  if (const MadePicture* const picture = made(use.path)) {
    return files_.add_texture(picture->texels, picture->width, picture->height, path_.string() + ", texture " + use.path,
                              use.edges);
  }
  const aiTexture* const within = file_ == nullptr ? nullptr : file_->GetEmbeddedTexture(use.path.c_str());
  if (within == nullptr) {
    return files_.add_texture(file_of(use.path), use.edges);
  }
  const std::string name = path_.string() + ", texture " + use.path;
  if (within->mHeight > 0) {
    check_texture_size(name, within->pcData == nullptr ? 0 : within->mWidth, within->mHeight);
    return files_.add_texture(texels_of(*within, use.edges.alpha == TextureAlpha::kept), within->mWidth, within->mHeight, name,
                              use.edges);
  }
  const auto* const bytes = reinterpret_cast<const std::byte*>(within->pcData);
  files_.add_texture({bytes, within->mWidth}, name, within->achFormatHint, use.edges);
}

std::optional<std::uint32_t> TextureReader::find(const TextureUse& use) { return find(use, key_of(use)); }

std::optional<std::uint32_t> TextureReader::find_numbers(const TextureUse& use) { return find(use, key_of(use) + " numbers"); }

std::optional<std::uint32_t> TextureReader::find(const TextureUse& use, const std::string& key) {
  const auto [known, is_new] = known_.try_emplace(key);
  if (is_new) {
    try {
      read(use);
      textures_.push_back({.name = use.path, .levels = {}});
      known->second = static_cast<std::uint32_t>(textures_.size() - 1);
    } catch (const core::InputError& error) {
      missing_.insert(error.what());
    }
  }
  return known->second;
}

}  // namespace dmpc::apps
