// The iPSC/2 with prices for the article's own structure, a plain grid of voxels: the study `paper` alone has it. The preset
// ipsc2 stays as it is, whose prices are those of dmpc's grid.
#pragma once

#include "nodes/machine.h"

namespace dmpc::apps {

/// The three numbers that four cells of Table 3 determine, each a multiple of what today's core takes. Four cells of two scenes
/// have two slopes over nodes, which say what a look-up of a cached page costs, and two levels, which say no more than two
/// numbers of what a ray does. So its operations are tied together by the proportions of core::measured_prices.
struct VoxelPrices {
  /// Prices of the traversal: a step to the next voxel with its entry read; a reference read and its polygon tested, which are
  /// one operation here, as a record read and a test, since each reference that is read has its polygon tested.
  double walk = 0;
  double rays = 0;           ///< of a ray set up, and of a hit shaded
  double cached_lookup = 0;  ///< of a look-up of a page that is not at home, beyond that of one that is

  bool operator==(const VoxelPrices&) const = default;
};

/// Fitted to Mountain on 1 and 64 nodes and Rings4 on 2 and 64, its smallest and largest machines, by the time of a ray: the
/// study's table of prices fits them again.
inline constexpr VoxelPrices fitted_voxel_prices{.walk = 8386, .rays = 33'985, .cached_lookup = 5150};

/// The preset with these prices; what a page or a message costs is the preset's.
nodes::Machine voxel_machine(const VoxelPrices& prices);

}  // namespace dmpc::apps
