// A scene's objects as the primitives that records hold.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/base/vec.h"
#include "core/database/database.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/parallel.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// A coordinate beyond this share of float's range cannot be mapped to a grid.
inline constexpr double coordinate_max = 1e30;

inline bool usable(const Vec3d& v) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

/// A position on a texture that is not a number is replaced by the texture's corner, and so is one too far away to be told from
/// its neighbours.
inline std::array<float, 2> usable_place(std::array<float, 2> place) {
  constexpr float place_max = 0x1p20F;
  for (float& coordinate : place) {
    coordinate = std::fabs(coordinate) < place_max ? coordinate : 0.0F;
  }
  return place;
}

/// PrimitiveSource::object of the stand-in for an instance whose copy is left out.
inline constexpr std::uint32_t source_is_place = 0xffffffffU;

/// Primitives by id, in the order of the file's objects.
struct Conversion {
  /// Vertex normals of a smooth triangle, before they have a record.
  struct Smooth {
    std::uint32_t primitive;
    PatchNormals normals;
  };
  /// A textured triangle, likewise; its references to textures, unless its corners have colours, are set later.
  struct Textured {
    std::uint32_t primitive;
    std::uint32_t texture;  ///< index into Scene::textures, or Material::no_texture
    std::uint32_t facets;   ///< index of the texture of metal and roughness, likewise
    TexturedNormals normals;
  };
  std::vector<PrimitiveValues> primitives;
  std::vector<PrimitiveSource> sources;
  std::vector<ShadingReference> shading;  ///< for flat ones
  /// If requested: for each triangle, which corners of its object it has.
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<Smooth> smooth;
  std::vector<Textured> textured;
  std::vector<CollapsedPrimitive> collapsed;  ///< without those that were degenerate before rounding
  std::uint32_t dropped = 0;                  ///< degenerate: zero area or length, radius 0, not finite
  // From instances of meshes, and from settle_coplanar() and drop_twins():
  std::vector<PrimitivePlane> planes;  ///< by PrimitiveValues::plane() - 1
  std::int32_t place_layers = 0;       ///< the highest layer of a plane of instances whose copies are left out
  struct Lamp {
    std::uint32_t primitive;
  };
  std::vector<Lamp> whole_lamps;    ///< triangles that share a plane, emit, and are not covered
  std::uint32_t shared_planes = 0;  ///< total: `planes`, and those given by a coordinate
  std::uint32_t duplicates = 0;     ///< triangles left out
  std::vector<CloseFaces> close_faces;
};

/// The bounds of everything finite in the scene.
Box bounds_of(const Scene& scene, const Parallel& parallel);

struct ConversionWishes {
  std::span<const MeshFaces> meshes = {};  ///< for all of Scene::kept
  bool keeps_corners = false;              ///< for a scene without base meshes
};

/// Triangulates, and transforms everything into the grid's coordinates. An instance of a base mesh has its triangles, in its
/// order, except those that are degenerate here after rounding, and its planes. Where copies are left out an empty box stands for
/// each instance, with source_is_place. The result does not depend on the number of threads.
Conversion convert(const Scene& scene, const GridFrame& frame, const Parallel& parallel, const ConversionWishes& wishes = {});

/// Reorders primitives: entry `i` becomes what is at `from[i]`; `from` may be shorter than the lists.
void rearrange(Conversion& conversion, const std::vector<std::uint32_t>& from);

}  // namespace dmpc::core
