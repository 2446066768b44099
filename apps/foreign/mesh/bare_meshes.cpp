#include "apps/foreign/mesh/bare_meshes.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "apps/foreign/mesh/invented.h"
#include "apps/foreign/text/xml_tags.h"

namespace dmpc::apps {
namespace {

/// How many blocks of this name there are, but for templates, which say what blocks are like.
struct BlockCounts {
  std::uint64_t meshes = 0, lists = 0;
};

/// In a text whose words stand between blanks, braces and marks, with remarks behind # and // and texts in quotes.
BlockCounts count_blocks(std::string_view text) {
  constexpr std::string_view between = " \t\r\n{};,";
  BlockCounts counts;
  std::string_view before;
  for (std::size_t at = text.find_first_not_of(between); at != std::string_view::npos; at = text.find_first_not_of(between, at)) {
    const std::string_view rest = text.substr(at);
    if (rest[0] == '#' || rest.starts_with("//") || rest[0] == '"') {
      at = behind(text, rest[0] == '"' ? "\"" : "\n", at + 1);
      continue;
    }
    const std::string_view word = rest.substr(0, rest.find_first_of(between));
    counts.meshes += word == "Mesh" && before != "template" ? 1 : 0;
    counts.lists += word == "MeshMaterialList" && before != "template" ? 1 : 0;
    before = word;
    at += word.size();
  }
  return counts;
}

/// "xof 0303txt 0032": what the file is written in.
bool is_text(std::string_view file) { return file.starts_with("xof ") && file.substr(8).starts_with("txt"); }

}  // namespace

std::uint64_t count_bare_meshes(const aiScene& scene, std::string_view file) {
  const std::span meshes(scene.mMeshes, scene.mNumMeshes);
  if (scene.mNumMaterials == 0 || is_invented_for_x(*scene.mMaterials[0])) {
    return 0;
  }
  if (is_text(file)) {
    const BlockCounts counts = count_blocks(file);
    return counts.meshes - std::min(counts.meshes, counts.lists);
  }
  const auto first = std::count_if(meshes.begin(), meshes.end(), [](const aiMesh* mesh) { return mesh->mMaterialIndex == 0; });
  return first > 1 ? static_cast<std::uint64_t>(first) : 0;
}

}  // namespace dmpc::apps
