// Meshes that stand in several places of a scene, and are there but once.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// Scene::objects from `first` to before `end`: polygons, patches and textured patches in coordinates of their own. Where they
/// stand instances say.
struct SharedMesh {
  std::uint32_t first = 0, end = 0;
};

/// A mesh in one place.
struct Instance {
  Transform world;           ///< from the mesh's coordinates
  std::uint32_t mesh = 0;    ///< index into Instances::meshes
  std::uint32_t before = 0;  ///< it comes after so many of Scene::objects
};

/// Whoever takes a scene's objects for what is there has to expand() or leave() these first.
struct Instances {
  std::vector<SharedMesh> meshes;  ///< one after the other, not empty
  std::vector<Instance> places;    ///< in the file's order: `before` does not fall

  bool empty() const { return meshes.empty() && places.empty(); }
};

/// What the pools of a scene hold once its instances are expanded, at most: normals that turn out to be the faces' own need no
/// room.
ExpandedSize expanded_size(const Scene& scene, const Instances& instances);

/// Puts a copy of each mesh in each of its places, where the file's order has it, and takes the meshes themselves away. Corners
/// are placed in double; normals by the inverse transpose; a mirror's faces are turned back; what is pressed flat has the normals
/// of its plane, and so has a face whose normals say no more than that (core/scene/face_normals.h). All pools are in the order
/// of the objects. Of meshes that are large and stand in several places it leaves what is decided of them by themselves in
/// Scene::kept. Throws CapacityError if pools outgrow 32 bits.
void expand(Scene& scene, const Instances& instances);

/// Whether a scene has copies of its base meshes among its objects.
enum class Copies : std::uint8_t { put, left_out };

/// As expand(), but what Scene::kept has is left out of the objects: a mesh's place takes 112 bytes, whatever the mesh holds.
/// Throws CapacityError if there would be more objects with all copies than 32 bits count.
void leave(Scene& scene, const Instances& instances);

/// The one or the other.
void settle(Scene& scene, const Instances& instances, Copies copies);
/// What the pools hold then, at most.
ExpandedSize settled_size(const Scene& scene, const Instances& instances, Copies copies);

}  // namespace dmpc::core
