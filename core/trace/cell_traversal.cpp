#include "core/trace/cell_traversal.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dmpc::core {
namespace {

/// The number of macro cells on the way from one to another, from neighbour to neighbour.
std::int32_t macro_cells_between(const Corner& from, const Corner& to) {
  return (std::abs(to[0] - from[0]) + std::abs(to[1] - from[1]) + std::abs(to[2] - from[2])) / finest_per_macro;
}

}  // namespace

CellTraversal::CellTraversal(const Ray& ray, const GridFrame& frame, const Region& region)
    : planes_(ray, frame), grid_{.high = grid_size(frame)}, region_(region), whole_(is_whole(region, grid_.high)) {}

void CellTraversal::move_to(const Region& region) {
  region_ = region;
  whole_ = is_whole(region, grid_.high);
}

/// Whether the ray has crossed a plane when it enters a cell at t through a plane of `entry_axis`: planes of lower axes at equal
/// t come first, those of higher axes come after it.
bool CellTraversal::crossed(std::size_t axis, std::int32_t index, double t, std::uint8_t entry_axis) const {
  const double at = plane(axis, index);
  return at < t || (at == t && (axis < entry_axis || entry_axis == traversal_starts));
}

/// The finest cell in [low, high) that holds the ray at t.
std::int32_t CellTraversal::locate(std::size_t axis, double t, std::int32_t low, std::int32_t high,
                                   std::uint8_t entry_axis) const {
  const double guess = std::clamp(planes_.place(axis, t), static_cast<double>(low), static_cast<double>(high - 1));
  const auto cell = static_cast<std::int32_t>(guess);  // not negative: truncation is the floor
  return settle(cell, low, high, planes_.step(axis), [&](std::int32_t index) { return crossed(axis, index, t, entry_axis); });
}

/// The lower corner of the macro cell that holds the ray at t, among those with finest cells in [low, high).
std::int32_t CellTraversal::locate_macro(std::size_t axis, double t, std::int32_t low, std::int32_t high,
                                         std::uint8_t entry_axis) const {
  const double guess = std::clamp(planes_.place(axis, t), static_cast<double>(low), static_cast<double>(high - 1));
  const auto cell = static_cast<std::int32_t>(guess);
  // The guess is off by at most 2^-31 of the scene, less than a finest cell, so it can be wrong only next to a border.
  const std::int32_t inside = cell & (finest_per_macro - 1);
  const bool is_certain = inside > 0 && inside < finest_per_macro - 1 && t < near_t_max;
  return (is_certain ? cell : locate(axis, t, low, high, entry_axis)) & -finest_per_macro;
}

bool CellTraversal::enter(const Ray& ray, Cursor& cursor) const {
  const std::optional<double> t_enter = planes_.entry(grid_.high, ray.t_max);
  if (!t_enter) {
    return false;
  }
  cursor.t_enter = *t_enter;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cursor.cell[axis] = locate_macro(axis, *t_enter, 0, grid_.high[axis], traversal_starts);
  }
  cursor.stage = Cursor::Stage::directory;
  return true;
}

/// Leaves the box of empty cells nearer than `radius` to the cursor's cell in one step.
bool CellTraversal::jump(const Ray& ray, std::int32_t radius, Cursor& cursor, Operations& operations) const {
  const std::int32_t reach = radius * finest_per_macro;
  const Corner from = cursor.cell;
  Region box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::max(0, from[axis] - reach + finest_per_macro);
    box.high[axis] = std::min(grid_.high[axis], from[axis] + reach);
  }
  const bool goes_on = leave(ray, exit_through(planes_ahead(from, reach, grid_)), &box, cursor, operations);
  operations.empty_cells += static_cast<std::uint64_t>(std::max(macro_cells_between(from, cursor.cell), 1) - 1);
  return goes_on;
}

void CellTraversal::leave_region(const Ray& ray, const Corner& cell, Cursor& cursor, Operations& operations) const {
  cursor.cell = cell;
  leave(ray, region_exit(), &region_, cursor, operations);
}

/// The finest cell that the ray enters with the cursor's cell, through the plane at finest index `face` of the entry axis.
Corner CellTraversal::finest_cell_of(const Cursor& cursor, std::int32_t face) const {
  Corner finest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t low = cursor.cell[axis], high = std::min(low + finest_per_macro, grid_.high[axis]);
    finest[axis] = axis == cursor.entry_axis ? face : locate(axis, cursor.t_enter, low, high, cursor.entry_axis);
  }
  return finest;
}

/// Whether the cell just entered belongs to this region; if not, stores where the ray has gone.
bool CellTraversal::stays(Cursor& cursor, std::int32_t face) const {
  if (region_.contains(cursor.cell, finest_per_macro)) {
    return true;
  }
  cursor.arrival = finest_cell_of(cursor, face);
  if (region_.contains(cursor.arrival)) {
    return true;
  }
  cursor.stage = Cursor::Stage::left;
  return false;
}

Corner CellTraversal::first_cell(const Cursor& cursor) const { return finest_cell_of(cursor, 0); }

}  // namespace dmpc::core
