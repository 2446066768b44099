// What is done for all rays of a bundle at once: SIMD where the machine has it, with the same bits everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/region.h"
#include "core/record/record.h"
#include "core/trace/bundle.h"
#include "core/trace/kernel.h"
#include "core/trace/operations.h"

namespace dmpc::core {

/// The far sides of a box of cells: one plane per axis for rays with a step of +1, and one for the others.
struct PlanesAhead {
  Corner above{}, below{};
};

/// For each ray the planes, one per axis, through which it may leave a box of its own.
using PlaneRows = std::array<Row<std::int32_t>, 3>;

/// Steps of bundles: each does for the rays of `bundle` what CellTraversal does for one, with the same bits.
struct BundleSteps {
  /// Fills the rows from bundle.rays and takes the rays that meet the grid to their first cells: those in the region are `alive`,
  /// the others have `left`.
  void (*enter)(RayBundle& bundle, const GridFrame& frame, const Region& region);
  /// Selects the live rays that are in the cell of the first live ray. Sets `cell` and `group`.
  void (*next_group)(RayBundle& bundle);
  /// Finds where the rays of the group cross the planes.
  void (*find_exits)(RayBundle& bundle, const PlanesAhead& ahead);
  /// Takes the rays of `leaving`, whose exits are found, to the next cell: the neighbour, or, from several cells `around`, the
  /// one that holds the ray. Rays whose traversal has ended, or that have left the region, are no longer alive. Returns how many
  /// cells they have passed, in addition to one each.
  std::uint64_t (*leave)(RayBundle& bundle, RayMask leaving, const PlanesAhead& ahead, const Region* around);
  /// Finds where rays that have left the region leave the boxes that they have entered.
  void (*find_box_exits)(RayBundle& bundle, RayMask rays, const PlaneRows& planes);
  /// pass(): takes the rays, whose exits are found, out of their boxes as if these were empty, and returns those that go on, with
  /// their passages updated. The others end in their boxes.
  RayMask (*pass_boxes)(RayBundle& bundle, RayMask rays, const PlaneRows& planes);
};

/// Work on one record: each does for the rays of `rays` what the kernels of kernel.h do for one.
struct BundleIntersectors {
  /// Adds the children that some of the rays meet, with these rays, to the waiting ones, the nearest last; with bundle.any in the
  /// node's order, and without where rays enter.
  void (*meet_children)(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays);
  /// Sets `next` and `next_rays` to the last waiting child that some of its rays may still want; none if there is none.
  void (*take_child)(RayBundle& bundle);
  /// How many waiting children rays of `rays` have met, each counted once for each ray.
  std::uint64_t (*count_waiting)(const RayBundle& bundle, RayMask rays);
  /// Merges hits with the triangles of the leaf at `leaf` into `best` and `found`. With bundle.any a ray's first hit will do.
  void (*hit_triangles)(RayBundle& bundle, const TriangleRows& triangles, Address leaf, RayMask rays);
};

/// The steps and tests for instruction set number `rank` that this processor has, the fastest first; nullptr if it has no more.
const BundleSteps* bundle_steps(std::size_t rank);
const BundleIntersectors* bundle_intersectors(std::size_t rank);
/// Rank 0.
extern const BundleSteps& fastest_bundle_steps;
extern const BundleIntersectors& fastest_bundle_intersectors;

}  // namespace dmpc::core
