// What a mesh file has and a picture of ours does not show.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <vector>

#include "apps/foreign/mesh/placement.h"

namespace dmpc::apps {

/// Appends a sentence, with a count, for each kind of thing that is there and not shown: textures, their transforms, what
/// surfaces' own light is not, clear coats, second texture coordinates, skins, morph targets, points and lines, animations. Only
/// meshes that are placed count, and the materials that these have.
void note_features(const aiScene& scene, const std::vector<Placement>& placements, std::vector<std::string>& notes);

}  // namespace dmpc::apps
