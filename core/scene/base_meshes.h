// Meshes of a scene with several instances, each by itself.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// An instance of a mesh.
struct BaseMeshInstance {
  Transform world;          ///< from the mesh's coordinates
  std::uint32_t mesh = 0;   ///< index into BaseMeshes::meshes
  std::uint32_t first = 0;  ///< the index of the copy's first object, with all copies: it has as many as the mesh, in its order
  std::uint32_t at = 0;     ///< index into Scene::objects, where the copy is or, if it is left out, would be
  bool has_copy = false;    ///< it is among Scene::objects. If it is left out core/scene/placed_objects.h makes it
};

/// Decisions made once for a mesh, and not for each of its instances: how its polygons are triangulated, what its normals mean,
/// and which of its faces lie in one plane. So it looks the same at any place and size, with copies or instances. Faces in one
/// plane are not searched for across instances, nor between an instance and the rest of the scene.
struct BaseMeshes {
  std::vector<Scene> meshes;             ///< only objects and their pools, in coordinates of their own; materials are the scene's
  std::vector<BaseMeshInstance> places;  ///< by `first`, ascending
};

/// A mesh with at most this many triangles is copied and then dropped, like one with a single instance.
inline constexpr std::uint64_t copied_triangles_max = 64;

/// A larger mesh is copied, too: trees of BVH nodes hold eight times as many, which allows for faces in one plane.
inline constexpr std::uint64_t base_mesh_triangles_max = std::uint64_t{1} << 21U;

/// Whether a mesh has an emitter; `materials`: those of its objects' indices.
bool shines(const Scene& mesh, const std::vector<Material>& materials);

/// Whether an instance may use a mesh that is judged by itself: not one that flattens it, or nearly so, nor one that moves it to
/// the limits of doubles.
bool can_be_instanced(const Transform& world);

/// The instance of which a scene's object is a copy; nullptr if there is none.
const BaseMeshInstance* place_of(const Scene& scene, std::uint32_t object);

/// The i-th corner of a copy is this one of the mesh's polygon, and the reverse: mirrored faces are reversed.
constexpr std::uint32_t placed_corner(bool is_mirrored, std::uint32_t corner_count, std::uint32_t i) {
  return is_mirrored ? corner_count - 1 - i : i;
}
/// placed_corner() of a triangle's three corners.
std::array<std::uint32_t, 3> placed_triangle(bool is_mirrored, std::uint32_t corner_count,
                                             const std::array<std::uint32_t, 3>& corners);

/// triangulate() of an object's corners or, if it is a copy, of its mesh's.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Scene& scene, std::uint32_t object);

/// The maximum number of primitives and instances of a tree with instances in its leaves (levels_above_instances).
inline constexpr std::uint64_t beside_places_max = 1U << 21U;

/// Numbers of corners of polygons: 3 per triangle.
struct InstancingShare {
  std::uint64_t seen = 0;    ///< with a copy of each mesh for each of its instances
  std::uint64_t stored = 0;  ///< with each mesh once; an instance counts as two triangles, since its record is as long as theirs
  std::uint64_t places = 0;
  std::uint64_t own = 0;  ///< primitives that are of no base mesh: triangles, spheres, cones

  /// Whether less than half of the scene remains to be stored.
  bool halves() const { return 2 * stored < seen; }
  /// Whether a tree can hold the primitives of no mesh and the instances, unless many faces cover others in their plane.
  bool has_room() const { return own + places <= beside_places_max; }
};

/// For a scene with copies of base meshes or without. Meshes with an emitter or too many triangles are not counted as base
/// meshes; other obstacles are not checked.
InstancingShare instancing_share(const Scene& scene);

}  // namespace dmpc::core
