// Static load balancing by subsampling: a sparse picture tells where in space the work is, and space is shared out accordingly.
//
// Source: D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in Parallel", 1994: neighbouring
// pixels cost about the same, so one pixel of every 8x8 predicts the load of every column of space.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>
#include <vector>

#include "core/build/database.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/regions/columns.h"

namespace dmpc::dataflow {

enum class Balance : std::uint8_t {
  subsampled,  ///< regions of about equal predicted load
  equal_size   ///< the naive split
};

struct BalanceOptions {
  Balance balance = Balance::subsampled;
  int subsample = 8;                    ///< one pixel of every subsample x subsample is traced; at least 1
  std::int32_t columns_per_side = 256;  ///< of the lattice that the loads are counted on; at least 1
  BspOptions bsp = {};
};

/// Regions, and what was known when they were made.
struct Balanced {
  Bsp bsp;
  std::vector<double> predicted;  ///< load of each region, by region number, in the unit of the columns'
};

/// The two grid axes most parallel to the screen, ascending: all but the one along which the camera looks most.
CutAxes axes_facing(const core::Camera& camera);

/// The pixels of the subsampled picture, in scan order: the middle one of every full subsample x subsample square, at least one.
std::vector<std::uint32_t> subsampled_pixels(int width, int height, int subsample);

/// The work that the rays of these pixels, of every kind, do in each column. Takes about as long as rendering them. After a stop
/// is requested it leaves out the rest of the pixels.
ColumnLoads measure_loads(const core::Database& database, const core::RenderSettings& settings, const ColumnLattice& lattice,
                          const std::vector<std::uint32_t>& pixels, const std::stop_token& stop = {});

/// What a subsampled picture tells: the load of each column in picoseconds, or none anywhere for Balance::equal_size.
/// Deterministic, unless a stop is requested: then it makes haste, and what is made of it is good for nothing but a run that ends
/// at once. Throws core::UsageError if an option is out of range.
ColumnLoads column_loads(const core::Database& database, const core::RenderSettings& settings, const BalanceOptions& options,
                         const std::stop_token& stop = {});

/// Shares the grid out to `region_count` regions, by the loads of column_loads() with the same options. Throws core::UsageError
/// if the count is out of range.
Balanced share_out(const ColumnLoads& loads, std::uint32_t region_count, const BalanceOptions& options);

}  // namespace dmpc::dataflow
