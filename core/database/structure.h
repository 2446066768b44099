// What the records of a scene are found by: a grid of trees, or one tree.
#pragma once

#include <cstdint>

namespace dmpc::core {

enum class Structure : std::uint8_t {
  grid,     ///< top cells, each with a tree of boxes
  extents,  ///< one top cell, so one tree of boxes over all; its subtrees, as large as a page holds, lie in one page each
};

}  // namespace dmpc::core
