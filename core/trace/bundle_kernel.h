// What a bundle's rays do all at once: SIMD where the machine has it, the same bits everywhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/region.h"
#include "core/record/record.h"
#include "core/trace/bundle.h"
#include "core/trace/kernel.h"
#include "core/trace/operations.h"

namespace dmpc::core {

/// The way out of a box of cells: the planes, one of each axis, that rays with a step of +1 come to, and those of the others.
struct PlanesAhead {
  Corner above{}, below{};
};

/// The planes, one of each axis, that each ray comes to when it leaves a box of its own.
using PlaneRows = std::array<Row<std::int32_t>, 3>;

/// How bundles walk: each does for the rays of `bundle` what Walk does for one, to the bit.
struct BundleSteps {
  /// From bundle.rays to rows, and the rays that meet the grid to their first cells: those that are in the region are `alive`,
  /// the others have `left`.
  void (*enter)(RayBundle& bundle, const GridFrame& frame, const Region& region);
  /// Chooses of the rays alive those in one cell: that of the first of them. Sets `cell` and `group`.
  void (*next_group)(RayBundle& bundle);
  /// Where the rays of the group leave for the planes.
  void (*find_exits)(RayBundle& bundle, const PlanesAhead& ahead);
  /// Takes the rays of `leaving`, whose exits are found, to the next cell: the neighbour, or, from several cells `around`, the
  /// one that holds the ray. Those whose walk has ended, or that have left the region, are no longer alive. Returns how many
  /// cells they have come by, beside one each.
  std::uint64_t (*leave)(RayBundle& bundle, RayMask leaving, const PlanesAhead& ahead, const Region* around);
  /// Where rays that have left leave the boxes into which they have gone.
  void (*find_box_exits)(RayBundle& bundle, RayMask rays, const PlaneRows& planes);
  /// pass(): takes the rays, whose exits are found, out of their boxes, as if nothing were there, and returns those that go on:
  /// their passages are where. The walks of the others end in their boxes.
  RayMask (*pass_boxes)(RayBundle& bundle, RayMask rays, const PlaneRows& planes);
};

/// What bundles do with a record: each does for the rays of `rays` what kernel.h's do for one.
struct BundleIntersectors {
  /// Adds the children that some of the rays meet, with those, to the ones that wait. `in_order`: the nearest last.
  void (*meet_children)(RayBundle& bundle, const BvhNode& bvh_node, RayMask rays, bool in_order);
  /// The child that waits last and some of its rays may still want: `next` and `next_rays`; none if there is none.
  void (*take_child)(RayBundle& bundle);
  /// How often rays of `rays` would still visit children that wait.
  std::uint64_t (*count_wanted)(const RayBundle& bundle, RayMask rays);
  /// Merges hits with the triangles of the leaf at `leaf` into `best` and `found`. With bundle.any a ray's first hit will do.
  void (*hit_triangles)(RayBundle& bundle, const TriangleRows& triangles, Address leaf, RayMask rays);
};

/// The steps and tests for instruction set number `rank` that this processor has, the fastest first; nullptr if it has no more.
const BundleSteps* bundle_steps(std::size_t rank);
const BundleIntersectors* bundle_intersectors(std::size_t rank);
/// Those of rank 0.
extern const BundleSteps& fastest_bundle_steps;
extern const BundleIntersectors& fastest_bundle_intersectors;

}  // namespace dmpc::core
