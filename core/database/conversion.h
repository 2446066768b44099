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

/// A coordinate beyond this share of float's range cannot be brought into a grid.
inline constexpr double coordinate_max = 1e30;

inline bool usable(const Vec3d& v) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

/// A place on a texture that is no number counts as the texture's corner; one that is too far away to be told from its
/// neighbours, too.
inline std::array<float, 2> usable_place(std::array<float, 2> place) {
  constexpr float place_max = 0x1p20F;
  for (float& coordinate : place) {
    coordinate = std::fabs(coordinate) < place_max ? coordinate : 0.0F;
  }
  return place;
}

/// PrimitiveSource::object of what stands for a place whose copy is left out.
inline constexpr std::uint32_t source_is_place = 0xffffffffU;

/// Primitives by id, in the order of the file's objects.
struct Conversion {
  /// Vertex normals of a smooth triangle, which have no record yet.
  struct Smooth {
    std::uint32_t primitive;
    PatchNormals normals;
  };
  /// A textured triangle, likewise; its references to textures, if its corners have no colours, are still to come.
  struct Textured {
    std::uint32_t primitive;
    std::uint32_t texture;  ///< index into Scene::textures, or Material::no_texture
    std::uint32_t facets;   ///< of that of metal and roughness, likewise
    TexturedNormals normals;
  };
  std::vector<PrimitiveValues> primitives;
  std::vector<PrimitiveSource> sources;
  std::vector<ShadingReference> shading;  ///< that of flat ones
  /// Where it was asked for: of triangles which corners of their objects they have.
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<Smooth> smooth;
  std::vector<Textured> textured;
  std::vector<CollapsedPrimitive> collapsed;  ///< of those, what was not degenerate before it was rounded
  std::uint32_t dropped = 0;                  ///< degenerate: zero area or length, radius 0, not finite
  // What places of meshes bring along, and settle_coplanar() and drop_twins() add:
  std::vector<PrimitivePlane> planes;  ///< by PrimitiveValues::plane() - 1
  std::int32_t place_layers = 0;       ///< the highest layer of a plane of places whose copies are left out
  struct Lamp {
    std::uint32_t primitive;
  };
  std::vector<Lamp> whole_lamps;    ///< of triangles that share a plane those that shine and that no other covers
  std::uint32_t shared_planes = 0;  ///< in all: `planes`, and those that a coordinate tells
  std::uint32_t duplicates = 0;     ///< triangles left out
  std::vector<CloseFaces> close_faces;
};

/// The bounds of what is finite in the scene.
Box bounds_of(const Scene& scene, const Parallel& parallel);

struct ConversionWishes {
  std::span<const MeshFaces> meshes = {};  ///< of Scene::kept, all of them
  bool keeps_corners = false;              ///< of a scene that keeps no meshes
};

/// Triangulates and brings all into the grid's coordinates. A place of a base mesh has that one's triangles, in its order, but
/// for those of which rounding leaves nothing here, and its planes. Where copies are left out an empty box stands for each place,
/// with source_is_place. The same whatever the number of threads.
Conversion convert(const Scene& scene, const GridFrame& frame, const Parallel& parallel, const ConversionWishes& wishes = {});

/// Gives primitives other places: at `i` comes what is at `from[i]`, which may be shorter than the lists.
void rearrange(Conversion& conversion, const std::vector<std::uint32_t>& from);

}  // namespace dmpc::core
