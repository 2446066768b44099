// The state, between two records, of up to 16 rays of one kind that traverse the grid together.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/region.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/cursor.h"
#include "core/trace/primitive.h"

namespace dmpc::core {

inline constexpr std::size_t bundle_rays_max = 16;

/// A bit for each ray of a bundle.
using RayMask = std::uint32_t;

/// Number of rays in the mask. Written out, since std::popcount is a call where not all processors have an instruction for it.
constexpr std::uint32_t count_of(RayMask rays) {
  const std::uint32_t pairs = rays - (rays >> 1U & 0x5555U);
  const std::uint32_t fours = (pairs & 0x3333U) + (pairs >> 2U & 0x3333U);
  return (((fours + (fours >> 4U)) & 0x0f0fU) * 0x0101U >> 8U) & 0x1fU;
}

/// One value per ray, side by side for SIMD.
template <class T>
using Row = std::array<T, bundle_rays_max>;

/// Up to this many rays of a BVH node are tested one by one, each against all its children at once.
inline constexpr std::size_t apart_max = 3;

/// Children that were met and not yet visited, the nearest last, each with the rays that met it. Not initialised.
struct BundleChildren {
  /// As MetChildren; where rays are tested one by one, which happens once on a way down, each adds its own children.
  static constexpr std::size_t count_max = MetChildren::count_max + (apart_max - 1) * bvh_children_max;

  alignas(64) std::array<Row<float>, count_max> t_enter;  ///< where each of the rays enters the box
  std::array<float, count_max> nearest;                   ///< about the least of t_enter: the sort key
  std::array<BvhChild, count_max> record;
  std::array<RayMask, count_max> rays;
  std::uint32_t count;
};

/// t, primitive, and where that was read, for up to 16 rays. A candidate whose record is on another node has `elsewhere` for a
/// leaf and the next higher id: so the same hit counts as nearer where it is met (see replaces()), and no other hit that did not.
struct BundleHits {
  static constexpr Address elsewhere{0xfffffffeU};
  alignas(64) Row<float> t;
  Row<std::uint32_t> primitive, leaf, lane;

  Hit of(std::size_t ray) const { return {t[ray], primitive[ray], Address{leaf[ray]}, lane[ray]}; }
  void set(std::size_t ray, const Hit& hit) {
    t[ray] = hit.t;
    primitive[ray] = hit.primitive;
    leaf[ray] = static_cast<std::uint32_t>(hit.leaf);
    lane[ray] = hit.lane;
  }
};

/// Rays and the state of their traversal, which core/trace/bundle_traversal.h takes from record to record. A step reads exactly
/// one record, and whatever the next one needs is here by value, as in a Cursor. Each ray has its own bit in the masks, its own
/// nearest hit and its own end. Neither initialised nor allocated: the owner provides the memory.
struct RayBundle {
  // Set by the owner.
  std::array<Ray, bundle_rays_max> rays;
  std::uint32_t count;  ///< number of rays, all of one kind
  RayMask arrived;      ///< rays that come from another region, by arrive()

  // Computed from the rays and the grid, with the bits of CellTraversal, BoxRay and ShearedRay.
  alignas(64) std::array<Row<float>, 3> origin, direction, reciprocal;
  Row<float> shear_x, shear_y, scale_z, t_max;
  Row<std::uint32_t> ignored_primitive;
  alignas(64) std::array<Row<double>, 3> slope, offset;
  std::array<RayMask, 3> forward;  ///< rays with a step of +1
  /// By the axis along which rays are sheared, and whether they go up (0) or down (1) along it.
  std::array<std::array<RayMask, 2>, 3> sheared_along;
  std::array<std::uint32_t, 3> near_row, far_row;  ///< rows of a BVH node's bounds, where all rays agree
  bool is_one_octant;                              ///< all rays agree
  Corner grid_size;                                ///< in finest cells
  Region region;                                   ///< the region that is traversed
  bool is_whole;                                   ///< the region is the whole grid: no ray leaves it
  float rest_most;                                 ///< the largest of ShearedRay::rest() of all rays
  Vec3d grid_low;                                  ///< where the grid begins
  double finest_cells;                             ///< finest cells in a unit of length

  // The state of the traversal.
  enum class Stage : std::uint8_t { start, directory, child, finished } stage;
  bool any;                                              ///< any hit will do
  RayMask alive;                                         ///< rays whose traversal has not ended
  RayMask found;                                         ///< rays that have a hit
  RayMask left;                                          ///< rays that have left the region: see passage()
  RayMask group;                                         ///< live rays in `cell`
  Corner cell;                                           ///< the lower corner of the macro cell that comes next, in finest cells
  BvhChild next;                                         ///< what the next step reads, with Stage::child
  RayMask next_rays;                                     ///< for these rays
  Address absent;                                        ///< the record that the traversal needs next
  std::array<RayMask, 3> exit_axis;                      ///< through which plane rays leave the cell
  alignas(64) std::array<Row<std::int32_t>, 3> cells;    ///< each ray's macro cell
  alignas(64) Row<double> t_enter, t_exit;               ///< where the ray enters its cell, and leaves it
  alignas(64) Row<float> t_low, t_high;                  ///< t_enter and t_exit for boxes
  std::array<Row<std::int32_t>, 3> arrival;              ///< the finest cell that a ray enters when it leaves the region
  std::array<std::uint8_t, bundle_rays_max> entry_axis;  ///< the axis of the plane through which it enters
  BundleHits best;
  BundleChildren waiting;

  /// The ray as triangle tests need it.
  ShearedRay sheared(std::size_t ray) const;

  RayMask all() const { return (RayMask{1} << count) - 1; }
  /// Begins the traversal, once `count` rays are set.
  void start() {
    stage = Stage::start;
    arrived = 0;
  }
  /// After start(): the ray does not begin here, but enters the region by `passage`.
  void arrive(std::size_t ray, const Passage& passage);
  /// A ray's nearest hit, or candidate, as Cursor::best has it.
  Hit hit(std::size_t ray) const;
  /// Where a ray that has left goes on.
  Passage passage(std::size_t ray) const;
};
static_assert(std::is_trivially_copyable_v<RayBundle>);

inline void RayBundle::arrive(std::size_t ray, const Passage& passage) {
  arrived |= RayMask{1} << ray;
  t_enter[ray] = passage.t_enter;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells[axis][ray] = passage.cell[axis] & -finest_per_macro;
  }
  const bool is_elsewhere = passage.best.found() && passage.best.leaf == no_address;
  best.set(ray, is_elsewhere ? Hit{passage.best.t, passage.best.primitive + 1, BundleHits::elsewhere} : passage.best);
}

inline Hit RayBundle::hit(std::size_t ray) const {
  const Hit hit = best.of(ray);
  return hit.leaf == BundleHits::elsewhere ? Hit{hit.t, hit.primitive - 1} : hit;
}

inline Passage RayBundle::passage(std::size_t ray) const {
  return {t_enter[ray], {arrival[0][ray], arrival[1][ray], arrival[2][ray]}, entry_axis[ray], hit(ray)};
}

inline ShearedRay RayBundle::sheared(std::size_t ray) const {
  const auto is = [&](std::size_t axis, std::size_t down) { return (sheared_along[axis][down] >> ray & 1U) != 0; };
  const std::uint32_t axis = is(0, 0) || is(0, 1) ? 0 : is(1, 0) || is(1, 1) ? 1 : 2;
  const std::uint32_t second = (axis + 1) % 3, third = (axis + 2) % 3;
  const bool is_down = is(axis, 1);
  return {{origin[0][ray], origin[1][ray], origin[2][ray]},
          rays[ray].origin_rest,
          shear_x[ray],
          shear_y[ray],
          scale_z[ray],
          is_down ? third : second,
          is_down ? second : third,
          axis};
}

}  // namespace dmpc::core
