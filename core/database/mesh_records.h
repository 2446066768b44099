// A kept mesh as its records hold it.
#pragma once

#include <optional>
#include <span>

#include "core/database/brick_tree.h"
#include "core/database/conversion.h"
#include "core/database/mesh_faces.h"
#include "core/database/parallel.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// In units of the mesh's coordinates, which floats hold exactly, with normals as the file has them.
struct MeshRecords {
  Conversion conversion;  ///< ids as in MeshFaces::triangles
  double unit = 1;        ///< a power of two
  BrickTree tree;
};

/// Nothing if the mesh cannot be kept: if a float does not hold a coordinate or normal of it, or if it shines by itself, since
/// paths aim at what does, one by one. `materials`: what its objects' indices are of.
std::optional<MeshRecords> records_of(const Scene& mesh, std::span<const Material> materials, const MeshFaces& faces,
                                      const Parallel& parallel);

}  // namespace dmpc::core
