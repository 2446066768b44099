// Faces so near to each other that only the file's doubles tell their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/database/faces/face.h"

namespace dmpc::core {

/// Planes that are parallel, or nearly so, and the faces in each.
///
/// Floats would merge them, or they are nearer to each other than rays start off a triangle. So their planes come from the
/// corners in the file, and are stored in the leaves. Edges stay those of the floats, since along a plane rounding shifts a face
/// and swaps nothing; across it t, points and starts of rays are exact to 2^-47 of the coordinates. Where a float t would be the
/// same for two planes, in_layer() (core/trace/primitive.h) tells them apart: it moves each t by a unit in the last place per
/// layer, in the order in which the ray hits them. So (t, id) decides as usual, in any box, node or kernel. Near faces of one
/// layer may be swapped where t is too coarse to tell them apart, and rays that start off such planes pass nearer ones:
/// RoundingLoss::swapped.
struct FaceStack {
  /// The faces of one plane, as far as doubles tell.
  struct Layer {
    PrimitivePlane plane;
    std::vector<std::uint32_t> ids;  ///< its faces, ascending
  };
  std::vector<Layer> layers;
  /// Faces that cover another one in their layer, in two planes or in one for lack of precision, or in another layer but on both
  /// sides of it: the smaller one, once each. For faces in another layer, the smaller one, if rays that start off one pass the
  /// other: its size is the part that lies nearer than rays start, and the distance of the two is 0.
  std::vector<CloseFaces> blurred;
};

/// Limits for all stacks of a scene: tests of a face with a plane, and with another face. What is not tested gets its own plane,
/// is unordered, and is reported.
struct StackBudget {
  std::size_t planes = std::size_t{1} << 28U, pairs = std::size_t{1} << 24U;
};

/// Whether faces, with the values of doubles, lie in one plane: then those that are moved by it from where the file has them, as
/// in FaceStack::blurred; otherwise nothing. Takes time in proportion to the faces.
std::optional<std::vector<CloseFaces>> merged_in_one_plane(std::span<const Face> faces);

/// Sorts faces, with the values of doubles, by their planes. Planes face the side of the faces that they cover; each is in a
/// layer above those that it covers from there, up to plane_layers_max. Planes that intersect where their faces cover each other
/// may be in any.
FaceStack stack_faces(std::span<const Face> faces, StackBudget& budget);

}  // namespace dmpc::core
