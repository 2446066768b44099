// Static load balancing by subsampling: a sparse picture predicts where in space the work is, and space is partitioned by it.
//
// Source: D. Badouel, K. Bouatouch, T. Priol, "Distributing Data and Control for Ray Tracing in Parallel", 1994: neighbouring
// pixels cost about the same, so one pixel of every 8x8 predicts the load of every column of space.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/regions/columns.h"
#include "dataflow/regions/regions.h"

namespace dmpc::dataflow {

enum class Balance : std::uint8_t {
  subsampled,  ///< regions of about equal predicted load
  equal_size,  ///< the naive split
  scattered,   ///< a regular lattice with many regions per node, neighbours on different nodes
  moving       ///< subsampled regions, each of many units, which nodes migrate to others during the run
};

struct BalanceOptions {
  Balance balance = Balance::subsampled;
  int subsample = 8;                 ///< one pixel of every subsample x subsample is traced; at least 1
  BspOptions bsp = {};               ///< unless scattered
  std::uint32_t regions_a_node = 1;  ///< scattered: from 1 on; moving: units, from 2 on; otherwise 1

  /// Whether a node may have more than one.
  bool has_several_regions() const { return balance == Balance::scattered || balance == Balance::moving; }
  /// Whether it needs measured loads.
  bool is_by_load() const { return balance == Balance::subsampled || balance == Balance::moving; }
};

/// Regions and their predicted loads.
struct Balanced {
  Regions regions;
  std::vector<double> predicted;  ///< load of each region, by region number, in the unit of the columns'
};

/// The two grid axes most parallel to the screen, ascending: all except the one closest to the view direction.
CutAxes axes_facing(const core::Camera& camera);

/// The work of all rays of these pixels, of every kind, in each column. Takes about as long as rendering them. After a stop is
/// requested it leaves out the rest of the pixels.
ColumnLoads measure_loads(const core::Database& database, const core::RenderSettings& settings, const ColumnLattice& lattice,
                          const std::vector<std::uint32_t>& pixels, const std::stop_token& stop = {});

/// The load of each column by a subsampled picture, in picoseconds, or 0 everywhere unless balancing needs it. Deterministic,
/// unless a stop is requested: then it ends early, and the result is only good for a run that ends at once. Throws
/// core::UsageError if an option is out of range.
ColumnLoads column_loads(const core::Database& database, const core::RenderSettings& settings, const BalanceOptions& options,
                         const std::stop_token& stop = {});

/// Partitions the grid for `node_count` nodes, by the loads of column_loads() with the same options. Throws core::UsageError if
/// there are more nodes, or regions, than can_share_out() allows.
Balanced share_out(const ColumnLoads& loads, std::uint32_t node_count, const BalanceOptions& options);
/// Whether share_out() can.
bool can_share_out(const ColumnLattice& lattice, std::uint32_t node_count, const BalanceOptions& options);

}  // namespace dmpc::dataflow
