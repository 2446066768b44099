// A mesh of Assimp's in its place.
#pragma once

#include <assimp/mesh.h>

#include <cstddef>
#include <string>

#include "apps/foreign/mesh/geometry.h"
#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/texture_place.h"
#include "apps/foreign/mesh/transform.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A material by the file's index.
struct MeshMaterial {
  core::Material material;
  unsigned coordinates = 0;  ///< which of a mesh's texture coordinates its texture goes by
  TexturePlace place{};      ///< where on its texture they lie
  bool is_cut_away = false;  ///< nothing of it is there
};

/// "mesh 3 'wheel'", for messages.
std::string name_of(const aiMesh& mesh, std::size_t index);

/// What its own faces of three or more corners become.
GeometrySize size_of(const aiMesh& mesh);

/// `triangles`, of vertices that exist, and its own faces of three or more corners, in the world: points and lines are left out,
/// a mirroring transform keeps the side to which a face looks. Places are read if `material` has a texture and the mesh the
/// coordinates for it. Throws core::InputError with the mesh's name for an index of a vertex that does not exist.
PolygonMesh placed_mesh(const aiMesh& mesh, std::size_t index, FaceList triangles, const Transform& world,
                        const MeshMaterial& material);

}  // namespace dmpc::apps
