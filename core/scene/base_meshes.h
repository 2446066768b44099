// Meshes of a scene that stand in several places of it, as they are by themselves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace dmpc::core {

/// A mesh in one of its places.
struct BaseMeshInstance {
  Transform world;          ///< from the mesh's coordinates
  std::uint32_t mesh = 0;   ///< index into BaseMeshes::meshes
  std::uint32_t first = 0;  ///< the index of the copy's first object, with all copies: as many come as the mesh has, in its order
  std::uint32_t at = 0;     ///< the same among Scene::objects, where the copy is or, if it is left out, would be
  bool has_copy = false;    ///< among Scene::objects. Where it is left out core/scene/placed_objects.h makes it
};

/// What is decided of a mesh, and not of each of its places: how its polygons are divided, what its normals say, and which of its
/// faces lie in one plane. So it looks alike wherever it stands and however large it is there, and whether its places are copies
/// or not. Across places nobody looks for faces in one plane, nor between a place and the rest of the scene.
struct BaseMeshes {
  std::vector<Scene> meshes;  ///< objects and their pools alone, in coordinates of their own; materials are the scene's
  std::vector<BaseMeshInstance> places;  ///< by `first`, ascending
};

/// A mesh of no more triangles is copied and then forgotten, as one that stands in one place is.
inline constexpr std::uint64_t copied_triangles_max = 64;

/// One of more is copied, too: trees of BVH nodes have room for eight times as many, and faces in one plane count so often.
inline constexpr std::uint64_t base_mesh_triangles_max = std::uint64_t{1} << 21U;

/// Whether something of a mesh shines by itself; `materials`: what its objects' indices are of.
bool shines(const Scene& mesh, const std::vector<Material>& materials);

/// Whether a place may have a mesh that is decided on elsewhere: one that presses it flat, or all but flat, may not, nor one that
/// takes it where doubles end.
bool can_be_instanced(const Transform& world);

/// The place of which an object of the scene's own is a copy; null if it is of none.
const BaseMeshInstance* place_of(const Scene& scene, std::uint32_t object);

/// The i-th corner of a copy is this one of the mesh's polygon, and the reverse: mirrors turn faces back.
constexpr std::uint32_t placed_corner(bool is_mirrored, std::uint32_t corner_count, std::uint32_t i) {
  return is_mirrored ? corner_count - 1 - i : i;
}
/// The same of a triangle's three.
std::array<std::uint32_t, 3> placed_triangle(bool is_mirrored, std::uint32_t corner_count,
                                             const std::array<std::uint32_t, 3>& corners);

/// triangulate() of an object's corners or, if it is a copy, of its mesh's.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const Scene& scene, std::uint32_t object);

/// So many primitives and places has a tree room for in whose leaves places stand (levels_above_instances).
inline constexpr std::uint64_t beside_places_max = 1U << 21U;

/// In corners of polygons: 3 of a triangle.
struct InstancingShare {
  std::uint64_t seen = 0;    ///< with a copy of each mesh in each of its places
  std::uint64_t stored = 0;  ///< with each mesh once; a place counts as two triangles, since its record is as long as theirs
  std::uint64_t places = 0;
  std::uint64_t own = 0;  ///< primitives of no mesh that is kept: triangles, spheres, cones

  /// Whether less than half of the scene is left to store.
  bool halves() const { return 2 * stored < seen; }
  /// Whether a tree has room for what is of no mesh and for the places, unless many faces cover others in their plane.
  bool has_room() const { return own + places <= beside_places_max; }
};

/// Of a scene with copies of base meshes or without. A mesh that shines or is too large is not kept; what else keeps one from it
/// is not asked.
InstancingShare instancing_share(const Scene& scene);

}  // namespace dmpc::core
