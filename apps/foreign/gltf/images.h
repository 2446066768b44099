// The pictures of a glTF document as textures of a scene of Assimp's.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/gltf/buffers.h"

namespace dmpc::apps::gltf {

class Images {
 public:
  Images(const Document& document, Buffers& buffers)
      : buffers_(buffers), images_(document.root().list("images")), numbers_(images_.size()) {}

  /// What a material calls the picture: the name of a file, or, of one within the document, its number behind a star.
  std::string name_of(std::size_t image);

  /// Those within the document for which somebody asked, by their numbers; `scene` owns them from now on.
  void give_to(aiScene& scene);

 private:
  Buffers& buffers_;
  std::vector<Part> images_;
  std::vector<std::optional<std::size_t>> numbers_;
  std::vector<std::vector<std::byte>> within_;
};

}  // namespace dmpc::apps::gltf
