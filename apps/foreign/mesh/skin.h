// Meshes in the pose in which their joints stand.
#pragma once

#include <string>
#include <vector>

#include "apps/foreign/mesh/imported_file.h"

namespace dmpc::apps {

/// Moves the vertices and normals of each mesh that has bones to where these hold them, in the root's parent's coordinates: by
/// the sum over bones of weight times the transform of the node of that name times the bone's offset matrix, the inverse bind
/// matrix (glTF 2.0, 3.7.3.2). Weights count as shares of their sum; a vertex without any stays with the node of its mesh. A mesh
/// with a bone of whose name there is no node loses its bones, and `notes` says so. Throws core::InputError, with the mesh's
/// name, for a weight that is below 0 or not finite, or of a vertex that does not exist.
void pose_skins(ImportedFile& file, std::vector<std::string>& notes);

}  // namespace dmpc::apps
