// What the records of a scene are found by: a grid of trees, one tree, or a plain grid.
#pragma once

#include <cstdint>

namespace dmpc::core {

enum class Structure : std::uint8_t {
  grid,     ///< top cells, each with a tree of boxes
  extents,  ///< one top cell, so one tree of boxes over all; its subtrees, as large as a page holds, lie in one page each
  voxels,   ///< small cells, each with a list of the primitives in it, without boxes
};

}  // namespace dmpc::core
