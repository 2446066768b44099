// Where a ray crosses the planes between finest cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/base/region.h"
#include "core/record/ray.h"
#include "core/record/record.h"

namespace dmpc::core {

/// Whether a region is a whole grid of this size. Written out, since a comparison of arrays is a function call.
constexpr bool is_whole(const Region& region, const Corner& size) {
  return (region.low[0] | region.low[1] | region.low[2]) == 0 && region.high[0] == size[0] && region.high[1] == size[1] &&
         region.high[2] == size[2];
}

/// Stands for the axis of the entry plane where the traversal starts in a cell.
inline constexpr std::uint8_t traversal_starts = 3;
/// Up to this t a point on a ray, in double, is off by less than 2^-31 of the grid.
inline constexpr double near_t_max = 0x1p20;

/// The cell in [low, high) that holds a ray with this `step` along the axis, searched from `cell` on. `crossed(index)`: whether
/// the ray has crossed that plane.
template <class Crossed>
std::int32_t settle(std::int32_t cell, std::int32_t low, std::int32_t high, std::int32_t step, const Crossed& crossed) {
  if (step > 0) {
    while (cell + 1 < high && crossed(cell + 1)) {
      ++cell;
    }
    while (cell > low && !crossed(cell)) {
      --cell;
    }
  } else if (step < 0) {
    while (cell > low && crossed(cell)) {
      --cell;
    }
    while (cell + 1 < high && !crossed(cell + 1)) {
      ++cell;
    }
  }
  return cell;
}

/// Values that follow from a ray and a grid, recomputed from the ray's bits on every node.
///
/// The only formula for planes: plane i of an axis (in finest cells) is crossed at t = i * slope + offset, in double. Rounding is
/// monotonic, so t always rises or falls with i.
class RayPlanes {
 public:
  RayPlanes(const Ray& ray, const GridFrame& frame)
      : origin_(Vec3d(ray.origin) - frame.low),
        direction_(ray.direction),
        reciprocal_(reciprocal_direction(ray)),
        finest_cells_(1.0 / double{frame.finest_cell}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      step_[axis] = d >= smallest_component ? 1 : d <= -smallest_component ? -1 : 0;
      if (step_[axis] != 0) {
        slope_[axis] = double{frame.finest_cell} * reciprocal_[axis];
        offset_[axis] = -origin_[axis] * reciprocal_[axis];
      } else {
        offset_[axis] = std::numeric_limits<double>::infinity();
      }
    }
  }

  /// As reciprocal_direction() returns it.
  const Vec3d& reciprocal() const { return reciprocal_; }
  /// -1, 0 or +1: the direction in which the ray crosses planes of the axis.
  std::int32_t step(std::size_t axis) const { return step_[axis]; }
  /// The t at which the ray crosses a plane, infinite along an axis without a step.
  double plane(std::size_t axis, std::int32_t index) const { return static_cast<double>(index) * slope_[axis] + offset_[axis]; }
  /// The ray's position at t, in finest cells, with rounding errors.
  double place(std::size_t axis, double t) const {
    return (step_[axis] == 0 ? origin_[axis] : origin_[axis] + t * direction_[axis]) * finest_cells_;
  }

  /// The t at which a traversal of a grid of `size` finest cells starts; nothing if the ray misses it or is not finite.
  std::optional<double> entry(const Corner& size, float t_max) const {
    const double sum = origin_.x + origin_.y + origin_.z + direction_.x + direction_.y + direction_.z;
    if (!(sum * 0.0 == 0.0)) {  // something is not finite: doubles cannot overflow from floats
      return std::nullopt;
    }
    double t_enter = 0.0, t_exit = double{t_max};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (step_[axis] == 0) {
        const double at = origin_[axis] * finest_cells_;
        if (!(at >= 0.0 && at < static_cast<double>(size[axis]))) {
          return std::nullopt;
        }
      } else {
        t_enter = std::max(t_enter, plane(axis, step_[axis] > 0 ? 0 : size[axis]));
        t_exit = std::min(t_exit, plane(axis, step_[axis] > 0 ? size[axis] : 0));
      }
    }
    return t_enter < t_exit ? std::optional(t_enter) : std::nullopt;
  }
  /// Whether the traversal that starts at `t_enter` starts in a finest cell from `index` on.
  bool starts_above(std::size_t axis, std::int32_t index, double t_enter) const {
    return step_[axis] == 0 ? origin_[axis] * finest_cells_ >= index : (plane(axis, index) <= t_enter) == (step_[axis] > 0);
  }

 private:
  Vec3d origin_;  ///< relative to the grid's lower corner
  Vec3d direction_, reciprocal_;
  std::array<double, 3> slope_{}, offset_{};
  std::array<std::int32_t, 3> step_{};
  double finest_cells_;  ///< finest cells in a unit of length
};

}  // namespace dmpc::core
