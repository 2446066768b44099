// Triangles before their corners are rounded to float.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/database/conversion.h"
#include "core/database/faces/face.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// The relative error in doubles of a coordinate that a program has rotated and translated, and of our own arithmetic with it;
/// for one near zero relative to the scene, since it comes from larger ones.
inline constexpr double exact_rounding = 0x1p-49;

/// Replaces in `faces` the triangles whose floats say little of their planes by those of the scene's doubles, with `moved` as for
/// floats. Returns whether there are any.
bool put_exact_corners(const Scene& scene, const GridFrame& frame, const Conversion& conversion, std::span<Face> faces);

/// Triangles of a conversion with the doubles of the scene, grid-local, in the order of `ids`. Takes time in proportion to them,
/// and to the corners of their polygons if those of one are consecutive. The scene still has its objects.
std::vector<Face> exact_faces(const Scene& scene, const GridFrame& frame, const Conversion& conversion,
                              std::span<const std::uint32_t> ids);

}  // namespace dmpc::core
