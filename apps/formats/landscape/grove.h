// Trees on the landscape's ground: many instances of a few trees.
#pragma once

#include <array>
#include <vector>

#include "apps/formats/landscape/tree.h"

namespace dmpc::apps {

/// A tree's position, its rotation about y (a unit quaternion, its real part last), and its height.
struct TreePlaces {
  std::vector<std::array<float, 3>> translations, scales;
  std::vector<std::array<float, 4>> rotations;
};

struct Grove {
  std::array<Tree, tree_kinds> trees;
  std::array<TreePlaces, tree_kinds> places;  ///< per kind of tree
};

/// One tree near each point of a lattice of 2^(size + 1) by 2^size over the ground, except in the lake, high up, on steep ground,
/// and around the camera; size from 1 to 12. Bit-identical on every machine.
Grove grove(int size);

}  // namespace dmpc::apps
