// Trees on the landscape's ground: a few of them, in very many places.
#pragma once

#include <array>
#include <vector>

#include "apps/formats/landscape/tree.h"

namespace dmpc::apps {

/// Where a tree stands, how it is turned about y (a quaternion of unit length, its real part last), and how high it is.
struct TreePlaces {
  std::vector<std::array<float, 3>> translations, scales;
  std::vector<std::array<float, 4>> rotations;
};

struct Grove {
  std::array<Tree, tree_kinds> trees;
  std::array<TreePlaces, tree_kinds> places;  ///< per kind of tree
};

/// One tree near each point of a lattice of 2^(size + 1) by 2^size over the ground, but in the lake, high up, where it is steep,
/// and around the camera; size from 1 to 12. The same to the last bit on every machine.
Grove grove(int size);

}  // namespace dmpc::apps
