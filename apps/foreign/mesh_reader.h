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
  IndexedVertices vertices;        ///< of the scene
  core::Instances instances;       ///< of what stands in several places, still to be expanded
  BoundingSphere bounds;           ///< of all of it, where an animation is asked for
  double light_share = 1;          ///< likewise, of the file's own lights
  std::vector<FileSky> skies;      ///< pictures, which who has the files shows
  std::vector<std::string> notes;  ///< what of the file is not shown as it is, a sentence each
};

/// At the moment of an animation, if one is asked for: then what is not the file's, a view of all and lights, is as in the still
/// scene that it names. All triangles and polygons, what stands in several places once, but for `options` that smooth it; the
/// file's first camera, else the whole scene in view; its lights, else two of ours; a plain background. Throws core::InputError
/// for what cannot be read or makes no scene (apps/foreign/mesh/geometry.h, apps/foreign/gltf/places.h), has no triangle at
/// all, or refers to files that cannot be had, unless `options` allow that; std::bad_alloc if memory ends.
MeshScene read_mesh(const std::string& path, const MeshOptions& options, SceneFiles& files);

}  // namespace dmpc::apps
