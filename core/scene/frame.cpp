#include "core/scene/frame.h"

#include <algorithm>
#include <cmath>

#include "core/base/elementary.h"

namespace dmpc::core {
namespace {

constexpr double flat_share = 1e-4;
/// Margin in cells between the grid's first plane and the scene.
constexpr double margin_cells = 0.3137 / 4;
constexpr double cells_min = 1.0;
/// The least extent, as a share of the largest coordinate: far more than what a double rounds off coordinates and radii, so that
/// the grid holds what its records say.
constexpr double far_share = 0x1p-36;
/// The extent given to a scene that is one point.
constexpr double point_extent = 1e-6;
/// What is smaller than this is given it: its scale, and the edges of its cells, would be no normal numbers.
constexpr double extent_min = 0x1p-1000;

double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

/// How many cubic cells of edge `cell` cover the extent, margins included.
std::array<std::int32_t, 3> cells_along(const Vec3d& extent, double cell) {
  std::array<std::int32_t, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count[axis] = static_cast<std::int32_t>(std::floor(extent[axis] / cell + 2 * margin_cells)) + 1;
  }
  return count;
}

/// The edge of a cell: cubic, about `wanted` of them over the box, with a bound for boxes that are flat or long.
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

/// Whose square does not vanish, in the same direction; as it is unless it is tiny.
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
  // In units of the scene, so that one scaled by a power of two gets the same grid to the last bit.
  const double cell = cell_edge(extent * frame.scale, wanted) / frame.scale;
  frame.resolution = cells_along(extent, cell);
  frame.finest_cell = static_cast<float>(cell * frame.scale / finest_per_cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double slack = (extent[axis] - (bounds.high[axis] - bounds.low[axis])) / 2;  // a flat scene lies in the middle
    frame.origin[axis] = bounds.low[axis] - slack - margin_cells * cell;
  }
  return frame;
}

double insertion_pad(const GridFrame& frame, double distance, std::int32_t layers) {
  const double finest = double{frame.finest_cell};
  const double extent = finest * finest_per_cell * *std::max_element(frame.resolution.begin(), frame.resolution.end());
  const double farthest = extent * (1.0 + distance);  // infinite for an eye that is too far for a double
  const double by_layers = layers > 0 ? 0x1p-23 * farthest * layers : 0.0;
  return std::max(1e-3 * finest, 0x1p-21 * farthest) + by_layers + 1e-6 * extent;
}

}  // namespace dmpc::core
