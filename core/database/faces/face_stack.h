// Faces that lie so near to each other that only the file's doubles tell which is before which.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/database/faces/face.h"

namespace dmpc::core {

/// Planes that are one after the other, or nearly so, and the faces in each.
///
/// Floats would make one of them, or they are nearer to each other than rays start off a triangle. So their planes come from the
/// corners as the file has them, and stand in the leaves. Edges stay those of the floats, since along a plane rounding shifts a
/// face and swaps nothing; across it t, points and starts of rays are right to 2^-47 of the coordinates. Where a float t
/// would be the same for two planes, in_layer() (core/trace/primitive.h) tells them apart: it moves each t by a unit in the last
/// place for each layer, in the order in which the ray comes to them. So (t, id) decides as ever, whatever box, node or kernel a
/// face is met in. Near faces of one layer may be swapped where t is too coarse to tell them apart, and what is nearer than rays
/// start off such planes is passed by those: RoundingLoss::swapped.
struct FaceStack {
  /// Of one plane, as far as doubles tell.
  struct Layer {
    PrimitivePlane plane;
    std::vector<std::uint32_t> ids;  ///< of the faces, ascending
  };
  std::vector<Layer> layers;
  /// Of those that cover another one and are in its layer, in two planes or in one for want of digits, or in another layer but on
  /// both sides of it: once each, the smaller one. And of those in another layer the smaller one, of which so much is passed by
  /// rays as lies nearer than they start off it: that is its size, and the two are 0 apart.
  std::vector<CloseFaces> blurred;
};

/// What all stacks of a scene may take: looks from a face at a plane, and at another face. What is not looked at has a plane of
/// its own, in no order, and is said to be.
struct StackBudget {
  std::size_t planes = std::size_t{1} << 28U, pairs = std::size_t{1} << 24U;
};

/// Whether faces, as doubles have them, lie in one plane: then those that it takes from where the file has them, as in
/// FaceStack::blurred; else nothing. Takes time in proportion to the faces.
std::optional<std::vector<CloseFaces>> merged_in_one_plane(std::span<const Face> faces);

/// Sorts faces, as doubles have them, by their planes. Planes face the side that those do which they cover; each is in a layer
/// above those that it covers from there, as far as plane_layers_max goes. Planes that cut each other where their faces cover
/// each other may be in any.
FaceStack stack_faces(std::span<const Face> faces, StackBudget& budget);

}  // namespace dmpc::core
