// Prices of operations on the article's own structure, a plain grid of voxels, for its machine, the iPSC/2.
#pragma once

#include "nodes/machine.h"

namespace dmpc::apps {

/// The three numbers that four cells of Table 3 determine, each a multiple of the cost in today's core. Four cells of two scenes
/// have two slopes over nodes, which determine the cost of a cached page's look-up, and two levels, which determine only two
/// numbers about a ray's operations. So the operations are tied together by the proportions of core::measured_prices.
struct VoxelPrices {
  /// Prices of the traversal: a step to the next voxel with its entry read; and a reference read with its polygon tested, which
  /// are one operation here, since each reference that is read has its polygon tested, and cost as much as a record read and a
  /// test.
  double walk = 0;
  double rays = 0;           ///< of setting up a ray, and of shading a hit
  double cached_lookup = 0;  ///< extra cost of looking up a page whose home is another node
};

/// Of the preset ipsc2-1994. Fitted to Mountain on 1 and 64 nodes and Rings4 on 2 and 64, their smallest and largest machines,
/// by the time of a ray: the table of prices of `dmpc study paper` repeats the fit.
inline constexpr VoxelPrices fitted_voxel_prices{.walk = 8386, .rays = 33'985, .cached_lookup = 5150};

/// Sets the prices of what rays do; what pages and messages cost stays.
void set_prices(nodes::Machine& machine, const VoxelPrices& prices);

}  // namespace dmpc::apps
