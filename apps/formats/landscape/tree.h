// The trees of a grove, each as triangles of bark and of leaves.
#pragma once

#include <cstddef>

#include "apps/formats/landscape/mesh.h"

namespace dmpc::apps {

/// Conifers (even numbers) and broad-leaved trees.
inline constexpr std::size_t tree_kinds = 4;
/// Boughs grow from a trunk, and twigs with leaves from each bough.
inline constexpr std::uint32_t tree_boughs = 20, bough_twigs = 6;
inline constexpr std::uint32_t bark_triangles = 48 + tree_boughs * (9 + 3 * bough_twigs), leaf_triangles = 2048 - bark_triangles;

/// A tree at the origin with height 1, y up; without texture coordinates. Bit-identical on every machine.
struct Tree {
  LandscapeMesh bark, leaves;
};
/// `kind` is below tree_kinds.
Tree tree(std::size_t kind);

}  // namespace dmpc::apps
