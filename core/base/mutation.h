// Known bugs of grids, shading and textures, put back on purpose by tests/mutation, so that the tests are seen to catch them.
#pragma once

namespace dmpc::core {

/// sign_of_minus_zero: the step along an axis is taken from d >= 0, the reciprocal from the sign bit, and -0 makes them disagree.
/// world_coordinates: the walk subtracts the grid's origin in single precision, at the world's magnitude.
/// contracted_edges: edge functions are fused on one side, as -ffp-contract=fast would.
/// exclusive_edges: an edge belongs to neither of its triangles: < where <= is meant, and the reverse.
/// shrunk_insertion: the box of a cell, within which a primitive is listed, is one unit in the last place too small.
/// exclusive_insertion: what only touches a cell is not listed there: >= where > is meant.
/// exchanged_places: a texture is looked up at t, s.
/// pixels_footprint: a sample's footprint on a texture is its pixel's, whatever the number of samples.
/// round_footprint: what lies at an angle is looked up in a circle as wide as the ellipse is long.
/// dropped_slant: what lies at an angle is looked up as what is seen straight on: the ellipse lacks a division by the cosine.
/// dropped_cone: the footprint of a mirrored ray begins with nothing at the mirror.
/// dropped_cosine: a surface is as bright at any angle to the light.
enum class Mutation {
  none,
  sign_of_minus_zero,
  world_coordinates,
  contracted_edges,
  exclusive_edges,
  shrunk_insertion,
  exclusive_insertion,
  exchanged_places,
  pixels_footprint,
  round_footprint,
  dropped_slant,
  dropped_cone,
  dropped_cosine
};

#ifndef DMPC_MUTATION
#define DMPC_MUTATION none
#endif
/// Which bug this build has: none but in tests/mutation.
inline constexpr Mutation mutation = Mutation::DMPC_MUTATION;

}  // namespace dmpc::core
