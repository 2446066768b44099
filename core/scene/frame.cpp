#include "core/scene/frame.h"

#include <algorithm>
#include <cmath>

#include "core/base/elementary.h"

namespace dmpc::core {
namespace {

constexpr double flat_share = 1e-4;
/// The margin in cells between the grid's first plane and the scene.
constexpr double margin_cells = 0.3137 / 4;
constexpr double cells_min = 1.0;
/// The minimum extent as a share of the largest coordinate: far more than the rounding of coordinates and radii in double, so
/// that the grid contains what its records describe.
constexpr double far_share = 0x1p-36;
/// The extent of a scene that is a single point.
constexpr double point_extent = 1e-6;
/// The minimum extent: for smaller ones the scale and the edges of cells would be denormal.
constexpr double extent_min = 0x1p-1000;

double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

/// The number of cubic cells of edge `cell` that cover the extent, margins included.
std::array<std::int32_t, 3> cells_along(const Vec3d& extent, double cell) {
  std::array<std::int32_t, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count[axis] = static_cast<std::int32_t>(std::floor(extent[axis] / cell + 2 * margin_cells)) + 1;
  }
  return count;
}

/// The edge of a cubic cell such that about `wanted` cells cover the box; bounded for flat or long boxes.
double cell_edge(const Vec3d& extent, double wanted) {
  double cell = exponential(natural_log(extent.x * extent.y * extent.z / wanted) / 3);  // the cube root
  for (;;) {
    const auto count = cells_along(extent, cell);
    if (static_cast<double>(count[0]) * count[1] * count[2] <= 2 * wanted + 8) {
      return cell;
    }
    cell *= 1.0625;
  }
}

/// Scales a tiny vector, in the same direction, so that its square does not vanish.
Vec3d enlarged(const Vec3d& way) { return largest_component(way) < 0x1p-500 ? way * 0x1p550 : way; }

}  // namespace

std::array<Vec3d, 3> screen_axes(const View& view) {
  const Vec3d forward = normalize(enlarged(view.at - view.from)), right = normalize(cross(forward, enlarged(view.up)));
  return {right, cross(right, forward), -forward};
}

GridFrame fit_frame(const Box& bounds, std::size_t primitive_count, double cells_per_primitive) {
  GridFrame frame;
  if (bounds.empty()) {
    frame.finest_cell = 1.0F / finest_per_cell;
    return frame;
  }
  Vec3d extent = bounds.high - bounds.low;
  const double least = far_share * std::max(largest(bounds.high), largest(-bounds.low));
  const double spread = std::max(largest(extent), least), size = spread > 0 ? std::max(spread, extent_min) : point_extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[axis] = std::max({extent[axis], flat_share * size, least});
  }
  const double wanted = std::max(cells_min, static_cast<double>(primitive_count) * cells_per_primitive);
  int exponent = 0;
  std::frexp(size, &exponent);
  frame.scale = std::ldexp(1.0, -exponent);
  // In units of the scene, so that a scene scaled by a power of two gets the same grid to the last bit.
  const double cell = cell_edge(extent * frame.scale, wanted) / frame.scale;
  frame.resolution = cells_along(extent, cell);
  frame.finest_cell = static_cast<float>(cell * frame.scale / finest_per_cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double slack = (extent[axis] - (bounds.high[axis] - bounds.low[axis])) / 2;  // centres a flat scene
    frame.origin[axis] = bounds.low[axis] - slack - margin_cells * cell;
  }
  return frame;
}

double eye_distance(const Vec3d& eye, const Box& bounds) {
  const Vec3d extent = bounds.high - bounds.low;
  return std::min(length(eye - bounds.center()) / std::max({extent.x, extent.y, extent.z, 1e-30}), 2 * far_eye_diagonals);
}

double insertion_pad(const GridFrame& frame, double distance, std::int32_t layers) {
  const double finest = double{frame.finest_cell};
  const double extent = finest * finest_per_cell * *std::max_element(frame.resolution.begin(), frame.resolution.end());
  const double farthest = extent * (1.0 + distance);  // infinite if the eye is too far away for a double
  const double by_layers = layers > 0 ? 0x1p-23 * farthest * layers : 0.0;
  return std::max(1e-3 * finest, 0x1p-21 * farthest) + by_layers + 1e-6 * extent;
}

}  // namespace dmpc::core
