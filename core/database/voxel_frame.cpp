#include "core/database/voxel_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/bounds.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::core {
namespace {

/// Voxels along an axis that are this share too few to cover it become larger, not more.
constexpr double rounding_share = 0x1p-20;

std::array<std::int32_t, 3> voxels_along(const Vec3d& extent, double edge) {
  std::array<std::int32_t, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    count[axis] = std::max(1, static_cast<std::int32_t>(std::ceil(extent[axis] / edge - rounding_share)));
  }
  return count;
}

double product(const std::array<std::int32_t, 3>& count) { return static_cast<double>(count[0]) * count[1] * count[2]; }

}  // namespace

GridFrame with_voxels(const GridFrame& frame, const Vec3d& extent, std::size_t primitive_count, const VoxelRule& rule) {
  expect(rule.voxels_per_primitive > 0 && rule.voxels_max > 0 && rule.voxels_max <= VoxelRule::voxels_bound,
         "a rule makes some voxels, and no more than a directory has room for");
  const double wanted = static_cast<double>(primitive_count) * rule.voxels_per_primitive;
  const double most = std::clamp(wanted, 1.0, static_cast<double>(rule.voxels_max));
  double edge = exponential(natural_log(extent.x * extent.y * extent.z / most) / 3);  // the cube root
  std::array<std::int32_t, 3> count = voxels_along(extent, edge);
  while (product(count) > most) {
    edge *= 1 + 0x1p-8;
    count = voxels_along(extent, edge);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    edge = std::max(edge, extent[axis] / count[axis]);
  }
  GridFrame voxels = frame;
  voxels.eye_extent = grid_high(frame) - frame.low;
  voxels.finest_cell = rounded_up(edge / finest_per_top);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    voxels.resolution[axis] = count[axis] * cells_per_top;
  }
  return voxels;
}

}  // namespace dmpc::core
