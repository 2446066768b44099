// The trees of a grove, each as triangles of bark and of leaves.
#pragma once

#include <cstddef>

#include "apps/formats/landscape/mesh.h"

namespace dmpc::apps {

/// Conifers (even numbers) and broad-leaved trees.
inline constexpr std::size_t tree_kinds = 4;
/// Boughs grow from a trunk, and twigs from each of them, which have the leaves.
inline constexpr std::uint32_t tree_boughs = 20, bough_twigs = 6;
inline constexpr std::uint32_t bark_triangles = 48 + tree_boughs * (9 + 3 * bough_twigs), leaf_triangles = 2048 - bark_triangles;

/// A tree that stands at 0 and is 1 high, y up; without places on a texture. The same to the last bit on every machine.
struct Tree {
  LandscapeMesh bark, leaves;
};
/// `kind` is below tree_kinds.
Tree tree(std::size_t kind);

}  // namespace dmpc::apps
