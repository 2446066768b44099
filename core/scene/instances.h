// Meshes with several instances in a scene, stored once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// Scene::objects from `first` to before `end`: polygons, patches and textured patches in coordinates of their own, placed by
/// instances.
struct SharedMesh {
  std::uint32_t first = 0, end = 0;
};

/// An instance of a mesh.
struct Instance {
  Transform world;           ///< from the mesh's coordinates
  std::uint32_t mesh = 0;    ///< index into Instances::meshes
  std::uint32_t before = 0;  ///< it comes before this index of Scene::objects
};

/// Code that uses a scene's objects has to expand() or leave() these first.
struct Instances {
  std::vector<SharedMesh> meshes;  ///< one after the other, not empty
  std::vector<Instance> places;    ///< in the file's order: `before` does not fall

  bool empty() const { return meshes.empty() && places.empty(); }
};

/// The maximum size of the pools of a scene after its instances are expanded: normals that turn out to be the faces' own take
/// nothing.
ExpandedSize expanded_size(const Scene& scene, const Instances& instances);

/// Adds a copy of each mesh for each of its instances, in the file's order, and removes the meshes themselves. Corners are
/// transformed in double; normals by the inverse transpose; mirrored faces are reversed; what is flattened has the normals of its
/// plane, and so has a face whose normals add nothing (core/scene/face_normals.h). All pools are in the order of the objects. For
/// meshes that are large and have several instances it stores the decisions made for them by themselves in Scene::kept. Throws
/// CapacityError if pools outgrow 32 bits.
void expand(Scene& scene, const Instances& instances);

/// Whether a scene has copies of its base meshes among its objects.
enum class Copies : std::uint8_t { put, left_out };

/// As expand(), but without the objects of instances in Scene::kept: an instance takes 112 bytes, for any size of its mesh.
/// Throws CapacityError if there would be more objects with all copies than 32 bits count.
void leave(Scene& scene, const Instances& instances);

/// expand() or leave().
void settle(Scene& scene, const Instances& instances, Copies copies);
/// The maximum size of the pools afterwards.
ExpandedSize settled_size(const Scene& scene, const Instances& instances, Copies copies);

}  // namespace dmpc::core
