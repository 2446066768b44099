#include "apps/foreign/mesh/textures.h"

#include <cstddef>

#include "apps/formats/named_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

std::string key_of(const TextureUse& use) {
  return use.path + '\n' + std::to_string(static_cast<int>(use.edges.s)) + std::to_string(static_cast<int>(use.edges.t)) +
         std::to_string(static_cast<int>(use.edges.alpha)) + ' ' + std::to_string(use.edges.cutoff) + ' ' +
         std::to_string(use.edges.coat);
}

/// Ends the key of a texture whose texels are no colours.
constexpr const char* numbers = " numbers";

}  // namespace

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
  const MadePicture* const picture = made(use.path);
  const std::string name = path_.string() + ", texture " + use.path;
  if (picture == nullptr) {
    files_.add_texture(file_of(use.path), use.edges);
  } else {
    files_.add_texture(picture->file, name, picture->format_hint, use.edges);
  }
}

void TextureReader::weigh(const std::optional<TextureUse>& color, const std::optional<TextureUse>& facets) {
  files_.only_weigh_textures(true);
  for (const auto& [use, end] : {std::pair(color, ""), {facets, numbers}}) {
    try {
      if (use && weighed_.insert(key_of(*use) + end).second) {
        read(*use);
      }
    } catch (const core::InputError&) {  // reported by find()
    }
  }
  files_.only_weigh_textures(false);
}

std::optional<std::uint32_t> TextureReader::find(const TextureUse& use) { return find(use, key_of(use)); }

std::optional<std::uint32_t> TextureReader::find_numbers(const TextureUse& use) { return find(use, key_of(use) + numbers); }

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
