// Fits prices of operations by least squares over cells of the article's Table 3.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "apps/frontend/machine/voxel_prices.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

/// Returns the preset ipsc2-1994 with these prices in place of the fitted ones.
nodes::Machine voxel_machine(const VoxelPrices& prices);

/// The time of a ray in a run with travelling pages, in node-milliseconds, as a function of the prices.
struct RayTime {
  std::array<double, 3> per_price{};  ///< per unit of each of VoxelPrices, in their order; idle time for want of work grows in
                                      ///< proportion to computing
  double rest = 0;                    ///< messages and waits for pages, as in the run

  double milliseconds(const VoxelPrices& prices) const;
};
/// Returns the ray time of a run on voxel_machine() with this number of nodes.
RayTime ray_time_of(const PaperResult& result);

/// A cell to be fitted.
struct PricedCell {
  RayTime time;
  double printed = 0;  ///< node-milliseconds a ray
};
/// Returns the non-negative prices with the least squares of relative errors; prices that the cells do not determine are 0.
/// Returns nothing if there are no cells.
std::optional<VoxelPrices> fit_prices(std::span<const PricedCell> cells);

}  // namespace dmpc::apps
