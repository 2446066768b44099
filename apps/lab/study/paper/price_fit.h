// Prices of operations by least squares over cells of the article's Table 3.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "apps/lab/study/paper/runs.h"
#include "apps/lab/study/paper/voxel_machine.h"

namespace dmpc::apps {

/// What a ray takes in a run whose pages travelled, in node-milliseconds, as it hangs on the prices.
struct RayTime {
  std::array<double, 3> per_price{};  ///< for one of each of VoxelPrices, in their order; nodes that idle for want of work do
                                      ///< so for as much longer as computing takes longer
  double rest = 0;                    ///< messages and waits for pages, as they were in the run

  double milliseconds(const VoxelPrices& prices) const;
};
/// A run on voxel_machine() with this number of nodes.
RayTime ray_time_of(const PaperResult& result);

/// A cell to be met.
struct PricedCell {
  RayTime time;
  double printed = 0;  ///< node-milliseconds a ray
};
/// The non-negative prices with the least squares of relative errors; where cells leave some of them open, those are 0. Nothing
/// of no cells.
std::optional<VoxelPrices> fit_prices(std::span<const PricedCell> cells);

}  // namespace dmpc::apps
