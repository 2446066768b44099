// A scene's objects as the primitives that records hold.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/box.h"
#include "core/database/database.h"
#include "core/database/parallel.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

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
  std::vector<Smooth> smooth;
  std::vector<Textured> textured;
  std::vector<CollapsedPrimitive> collapsed;  ///< of those, what was not degenerate before it was rounded
  std::uint32_t dropped = 0;                  ///< degenerate: zero area or length, radius 0, not finite
  // What settle_coplanar() adds, and drop_twins():
  std::vector<KeptPlane> planes;    ///< by PrimitiveValues::plane() - 1
  std::uint32_t shared_planes = 0;  ///< in all: `planes`, and those that a coordinate tells
  std::uint32_t duplicates = 0;     ///< triangles left out
  std::vector<CloseFaces> close_faces;
};

/// The bounds of what is finite in the scene, in the directions of `axes`.
Box bounds_of(const Scene& scene, const GridAxes& axes, const Parallel& parallel);

/// Triangulates and brings all into the grid's coordinates. The same whatever the number of threads.
Conversion convert(const Scene& scene, const GridFrame& frame, const Parallel& parallel);

/// Gives primitives other places: at `i` comes what is at `from[i]`, which may be shorter than the lists.
void rearrange(Conversion& conversion, const std::vector<std::uint32_t>& from);

}  // namespace dmpc::core
