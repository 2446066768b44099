// Reads a mesh file as a scene.
#pragma once

#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/foreign/mesh/scene_files.h"
#include "apps/formats/indexed_vertices.h"
#include "apps/formats/mesh_options.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

struct MeshScene {
  core::Scene scene;               ///< without vertices; its textures are names alone: who has the files has the texels
  IndexedVertices vertices;        ///< the scene's vertices
  core::Instances instances;       ///< meshes with several instances, still to be expanded
  BoundingSphere bounds;           ///< bounds of the whole, where an animation is asked for
  double light_share = 1;          ///< likewise, of the file's own lights
  std::vector<FileSky> skies;      ///< pictures, which who has the files shows
  std::vector<std::string> notes;  ///< what of the file is not shown as it is, a sentence each
};

/// Reads the file, at the moment of an animation if one is asked for: then the default view and lights are as in the still scene
/// that it names. The scene has all triangles and polygons, each instanced mesh once, unless `options` smooth it; the file's
/// first camera, else the whole scene in view; its lights, else two default ones; a uniform background. Throws core::InputError
/// for a file that cannot be read or makes no scene (apps/foreign/mesh/geometry.h, apps/foreign/gltf/places.h), has no triangle
/// at all, or refers to missing files, unless `options` allow that; std::bad_alloc if memory is exhausted.
MeshScene read_mesh(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps
