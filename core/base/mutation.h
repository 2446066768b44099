// Known bugs of grids, put back on purpose by tests/mutation, so that the robustness tests are seen to catch them.
#pragma once

namespace dmpc::core {

/// sign_of_minus_zero: the step along an axis is taken from d >= 0, the reciprocal from the sign bit, and -0 makes them disagree.
/// world_coordinates: the walk subtracts the grid's origin in single precision, at the world's magnitude.
/// contracted_edges: edge functions are fused on one side, as -ffp-contract=fast would.
/// exclusive_edges: an edge belongs to neither of its triangles: < where <= is meant, and the reverse.
/// shrunk_insertion: the box of a cell, within which a primitive is listed, is one unit in the last place too small.
/// exclusive_insertion: what only touches a cell is not listed there: >= where > is meant.
enum class Mutation {
  none,
  sign_of_minus_zero,
  world_coordinates,
  contracted_edges,
  exclusive_edges,
  shrunk_insertion,
  exclusive_insertion
};

#ifndef DMPC_MUTATION
#define DMPC_MUTATION none
#endif
/// Which bug this build has: none but in tests/mutation.
inline constexpr Mutation mutation = Mutation::DMPC_MUTATION;

}  // namespace dmpc::core
