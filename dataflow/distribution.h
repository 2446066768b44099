// What the host assigns to the nodes before the start: regions, the parts of the database for these, and primary rays.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/base/forget.h"
#include "core/database/database.h"
#include "core/database/extract.h"
#include "core/database/proxy.h"
#include "core/picture/pixel_task.h"
#include "core/trace/traversal.h"
#include "dataflow/plan.h"
#include "dataflow/rays/pixel_order.h"
#include "dataflow/rays/primaries.h"
#include "dataflow/regions/regions.h"

namespace dmpc::dataflow {

/// Makes regions for a number of nodes, with any balancing.
using MakeRegions = std::function<Regions(std::uint32_t node_count)>;
/// Shares for `node_count` nodes; nothing if space cannot be distributed over them.
using MakeShares = std::function<std::vector<Share>(std::uint32_t node_count)>;

/// Assignments by node.
struct Distribution {
  Regions regions;
  std::vector<core::DatabasePart> parts;
  std::vector<std::vector<PrimaryRun>> primaries;
  std::vector<std::vector<std::uint32_t>> pages;  ///< by node, if regions move: the pages of which the parts consist
  /// By node and unit, if regions move: the number of the node's runs that belong to the unit; they are consecutive, unit by
  /// unit.
  std::vector<std::vector<std::uint32_t>> runs_of_unit;
  std::size_t page_bytes = 0;  ///< page size
  core::DatabasePart proxy;    ///< for every node; empty (core/database/proxy.h) if rays are to go to every region

  std::vector<Share> shares() const;
  /// Copies of primitives in all parts over those in the database: at least about 1, more if cuts go through leaves.
  double duplication(const core::Database& database) const;
  /// Frees the parts' bytes, when the nodes have them.
  void forget_records() {
    for (core::DatabasePart& part : parts) {
      core::forget(part.bytes);
    }
    core::give_back_freed();
  }
};

/// Divides the database; values keep their bits. Marks empty regions, if they are to be skipped. After a stop is requested some
/// primary rays are assigned to nobody; without primary rays all of them wait. They start in `order`.
Distribution distribute(const core::Database& database, const core::RenderSettings& settings, const Regions& regions,
                        const std::stop_token& stop = {}, bool assigns_primaries = true, const PixelOrder& order = {});

/// Sizes of the parts that distribute() would assign, by node.
struct MeasuredParts {
  std::vector<std::size_t> record_bytes;
  std::size_t page_bytes = 0;  ///< as in Distribution
  std::size_t proxy_bytes = 0;
  double duplication = 1;  ///< as in Distribution
};

/// Measures the parts without keeping them. Marks regions in `regions` as distribute() does.
MeasuredParts measure_parts(const core::Database& database, const core::RenderSettings& settings, Regions& regions);

/// The shares that distribute() would assign for each of `partitions`, of which `parts` have been measured.
std::vector<std::vector<Share>> measure_shares(const core::RenderSettings& settings, std::span<const Regions> partitions,
                                               std::span<const MeasuredParts> parts, const std::stop_token& stop = {},
                                               bool assigns_primaries = true, const PixelOrder& order = {});

/// The smallest number of nodes above the request's with which make_plan() succeeds under the request's memory limit, as far as
/// bisection finds it: more nodes need less for their parts but more for their queues.
std::optional<std::uint32_t> smallest_node_count(PlanRequest request, const MakeShares& make_shares);

}  // namespace dmpc::dataflow
