// Meshes of X files that have no material, to which Assimp gives the file's first.
#pragma once

#include <assimp/scene.h>

#include <cstdint>
#include <string_view>

namespace dmpc::apps {

/// How many of an X file's meshes may show a material that is not theirs: none if it has no material; in text those that have no
/// list of materials, in binary, where lists are not looked for, all that have the first, if there are several.
std::uint64_t count_bare_meshes(const aiScene& scene, std::string_view file);

}  // namespace dmpc::apps
