// The places of many planes, found side by side.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/vec.h"
#include "core/base/vector_width.h"
#include "core/database/faces/face.h"

namespace dmpc::core {

/// A bucket's size in slopes, and in heights as a share of the space of the faces; two near planes share a bucket if they lean
/// towards each other by at most twice `leaning`.
struct BucketSize {
  double edge, leaning;
};
inline constexpr BucketSize fine_buckets{0x1p-9, 0x1p-13};
/// For triangles so small that rounding moves planes far apart: for those whose doubles are known.
inline constexpr BucketSize coarse_buckets{0x1p-5, 0x1p-7};

/// The space of the faces: heights are measured from its middle, relative to its size.
struct Surroundings {
  Vec3d middle;
  double size = 0;
};

/// The properties of a face that determine the position of its plane: as in Face.
struct PlacedFace {
  Vec3d normal, corner;
  double moved = 0, altitude = 0;
  double tilted = 1;   ///< 0 if it is level, else 1
  double rounded = 1;  ///< 0 if it is by doubles, else 1

  /// The possible error of its slopes.
  double slope_error(const BucketSize& size) const {
    // Corners that move across the plane turn the normal; slopes change by up to three times as much.
    const double turned = 8 * moved / altitude, near = near_roundings * turned, by_rounding = turned * rounded;
    const double leaning = near < size.leaning ? near : size.leaning;
    return (by_rounding < leaning ? leaning : by_rounding) * tilted;
  }
  /// Whether it is tested along an axis: the one that its plane faces most, or as much up to the error of its slopes, since a
  /// triangle in the same plane may face that one most. None if slopes are too uncertain.
  bool is_seen_along(std::size_t axis, double error, const BucketSize& size) const {
    const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
    const double xy = x < y ? y : x, most = (xy < z ? z : xy) * (1 - 4 * error) - 1e-12;
    return (error < size.edge) & (std::fabs(normal[axis]) >= most);
  }
};

/// Buckets along one dimension; their number per unit is a power of two, so that multiplication by it is exact.
struct BucketRange {
  std::int32_t first = 0, last = -1;

  static BucketRange around(double value, double error, double per_unit) {
    return {bucket_of(value - error, per_unit), bucket_of(value + error, per_unit)};
  }

 private:
  /// Planes perpendicular to an axis, which are frequent, lie in the middle of a bucket. Rounds down, faster than std::floor().
  static std::int32_t bucket_of(double value, double per_unit) {
    const double place = value * per_unit + 0.5;
    const auto towards_zero = static_cast<std::int32_t>(place);
    return towards_zero - (place < static_cast<double>(towards_zero) ? 1 : 0);
  }
};

/// The buckets where a plane may be.
struct PlanePlace {
  BucketRange slopes, other_slopes, heights;
};

/// For a face that is tested along an axis.
inline PlanePlace place_along(std::size_t axis, const PlacedFace& face, double error, const BucketSize& size,
                              const Surroundings& around) {
  const std::size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  const double per_unit = 1 / size.edge;
  const double one_over = 1 / face.normal[axis], slope = -face.normal[next] * one_over,
               other_slope = -face.normal[last] * one_over;
  const Vec3d away = around.middle - face.corner;
  const double height = (slope * away[next] + other_slope * away[last] - away[axis]) / around.size;
  const double near = 8 * (near_roundings * face.moved + layers_reach_of(face.altitude));
  const double wide = (near + error * (std::fabs(away[next]) + std::fabs(away[last]))) / around.size;
  const double height_error = size.edge < wide ? size.edge : wide;
  return {BucketRange::around(slope, error, per_unit), BucketRange::around(other_slope, error, per_unit),
          BucketRange::around(height, height_error, per_unit)};
}

/// Buckets of a few faces' planes, for each axis along which they are tested.
class PlaneLanes {
 public:
  static constexpr std::size_t count_max = 16;

  PlaneLanes(const BucketSize& size, const Surroundings& around, VectorWidth width = vector_width())
      : size_(size), around_(around), width_(width) {}

  /// For 1 to count_max faces, none of them degenerate.
  void find(std::span<const Face> faces);
  bool is_seen(std::size_t lane, std::size_t axis) const { return seen_[axis][lane] != 0; }
  /// Requires that the face is tested along the axis.
  PlanePlace place(std::size_t lane, std::size_t axis) const {
    const auto range = [&](std::size_t dimension) {
      return BucketRange{first_[axis][dimension][lane], last_[axis][dimension][lane]};
    };
    return {range(0), range(1), range(2)};
  }

 private:
  template <class T>
  using Row = std::array<T, count_max>;

  template <std::size_t axis>
  void find_along();

  BucketSize size_;
  Surroundings around_;
  VectorWidth width_;
  alignas(64) std::array<Row<double>, 3> normal_{}, corner_{};
  Row<double> moved_{}, altitude_{}, tilted_{}, rounded_{};
  std::array<Row<std::int32_t>, 3> seen_{};
  std::array<std::array<Row<std::int32_t>, 3>, 3> first_{}, last_{};  ///< by axis and dimension
};

}  // namespace dmpc::core
