// The textures of a mesh file's materials.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

/// Reads each texture once, from beside the mesh file or from within it.
class TextureReader {
 public:
  /// For a file at `path` that embeds `pictures`, which its materials call "*0", "*1", ... These and `files` outlive the reader.
  /// `textures` get names only.
  TextureReader(std::span<const MadePicture> pictures, const std::filesystem::path& path, SceneFiles& files,
                std::vector<core::Texture>& textures)
      : pictures_(pictures), path_(path), files_(files), textures_(textures) {}

  /// Checks the memory for two more textures before the first is read; an error ends the reading.
  void weigh(const std::optional<TextureUse>& color, const std::optional<TextureUse>& facets);

  /// Its index among the scene's textures; nothing if it is not available, which missing() reports.
  std::optional<std::uint32_t> find(const TextureUse& use);
  /// As above for a texture of numbers instead of colours: a separate texture, even if another one shows the same picture.
  std::optional<std::uint32_t> find_numbers(const TextureUse& use);

  /// "a.png: ...": what could not be had and why, once each, in the order of their names.
  std::vector<std::string> missing() const { return {missing_.begin(), missing_.end()}; }

  /// "wood.PNG for C:\art\wood.png": what was found elsewhere than the file says.
  std::vector<std::string> other_names() const { return {other_names_.begin(), other_names_.end()}; }

 private:
  std::optional<std::uint32_t> find(const TextureUse& use, const std::string& key);
  /// As the scene's next texture.
  void read(const TextureUse& use);
  /// That is meant by this name (apps/formats/named_file.h).
  std::string file_of(const std::string& name);

  /// The one that the file holds itself.
  const MadePicture* made(const std::string& name) const;

  std::span<const MadePicture> pictures_;
  std::filesystem::path path_;
  SceneFiles& files_;
  std::vector<core::Texture>& textures_;
  std::map<std::string, std::optional<std::uint32_t>> known_;  ///< by path and edges, and whether they are numbers
  std::set<std::string> weighed_, missing_, other_names_;
};

}  // namespace dmpc::apps
