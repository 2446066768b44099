#include "core/walk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/directory.h"
#include "core/expect.h"
#include "core/kernel.h"
#include "core/mutation.h"

namespace dmpc::core {
namespace {

constexpr std::uint8_t walk_starts = 3;
constexpr double never = std::numeric_limits<double>::infinity();
/// A direction component below this counts as 0, denormals and -0 included.
constexpr float smallest_component = 1e-18F;

/// The bit of the voxel at `cell` (a cell of `level`) in its brick's masks.
int voxel_bit(const std::array<std::int32_t, 3>& cell, int level) {
  const int shift = std::countr_zero(static_cast<unsigned>(span_of(level)));
  return (cell[0] >> shift & 3) + 4 * (cell[1] >> shift & 3) + 16 * (cell[2] >> shift & 3);
}

bool has(std::uint64_t mask, int bit) { return (mask >> bit & 1U) != 0; }

/// How many bits of `mask` lie below `bit`.
int rank(std::uint64_t mask, int bit) { return std::popcount(mask & ((std::uint64_t{1} << bit) - 1)); }

/// What is left of a local coordinate that went through the world's, in single precision.
[[maybe_unused]] double in_world_coordinates(double local, double grid_origin) {
  return double{static_cast<float>(local + grid_origin)} - double{static_cast<float>(grid_origin)};
}

}  // namespace

Walk::Walk(const Ray& ray, const GridFrame& frame, const Region& region)
    : origin_(ray.origin),
      direction_(ray.direction),
      size_(grid_size(frame)),
      region_(region),
      whole_(region == Region{.high = grid_size(frame)}),
      finest_cell_(double{frame.finest_cell}) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float d = ray.direction[axis];
    step_[axis] = d >= smallest_component ? 1 : d <= -smallest_component ? -1 : 0;
    double reciprocal = 1.0 / double{d};
    if constexpr (mutation == Mutation::sign_of_minus_zero) {
      step_[axis] = d >= 0.0F ? 1 : -1;
      reciprocal = 1.0 / double{std::copysign(std::max(std::fabs(d), smallest_component), d)};
    }
    if constexpr (mutation == Mutation::world_coordinates) {
      origin_[axis] = in_world_coordinates(origin_[axis], frame.origin[axis] * frame.scale);
    }
    if (step_[axis] != 0) {
      slope_[axis] = finest_cell_ * reciprocal;
      offset_[axis] = -origin_[axis] * reciprocal;
    }
  }
}

double Walk::plane(std::size_t axis, std::int32_t index) const {
  return step_[axis] == 0 ? never : static_cast<double>(index) * slope_[axis] + offset_[axis];
}

/// Whether the ray has crossed a plane when it enters a cell at t through a plane of `entry_axis`: planes of lower axes at equal
/// t come first, those of higher axes come after it.
bool Walk::crossed(std::size_t axis, std::int32_t index, double t, std::uint8_t entry_axis) const {
  const double at = plane(axis, index);
  return at < t || (at == t && (axis < entry_axis || entry_axis == walk_starts));
}

/// The lower corner of the cell of edge `span` in [low, high) that holds the ray at t.
std::int32_t Walk::locate(std::size_t axis, double t, std::int32_t span, std::int32_t low, std::int32_t high,
                          std::uint8_t entry_axis) const {
  const double along = step_[axis] == 0 ? origin_[axis] : origin_[axis] + t * direction_[axis];
  const double guess = std::clamp(along / finest_cell_, static_cast<double>(low), static_cast<double>(high - 1));
  std::int32_t cell = static_cast<std::int32_t>(guess) & -span;  // not negative: truncation is the floor
  if (step_[axis] > 0) {
    while (cell + span < high && crossed(axis, cell + span, t, entry_axis)) {
      cell += span;
    }
    while (cell > low && !crossed(axis, cell, t, entry_axis)) {
      cell -= span;
    }
  } else if (step_[axis] < 0) {
    while (cell > low && crossed(axis, cell, t, entry_axis)) {
      cell -= span;
    }
    while (cell + span < high && !crossed(axis, cell + span, t, entry_axis)) {
      cell += span;
    }
  }
  return cell;
}

bool Walk::enter(const Ray& ray, Cursor& cursor) const {
  if (!is_finite(origin_) || !is_finite(direction_)) {
    return false;
  }
  double t_enter = 0.0, t_exit = double{ray.t_max};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (step_[axis] == 0) {
      const double at = origin_[axis] / finest_cell_;
      if (!(at >= 0.0 && at < static_cast<double>(size_[axis]))) {
        return false;
      }
    } else {
      t_enter = std::max(t_enter, plane(axis, step_[axis] > 0 ? 0 : size_[axis]));
      t_exit = std::min(t_exit, plane(axis, step_[axis] > 0 ? size_[axis] : 0));
    }
  }
  if (!(t_enter < t_exit)) {
    return false;
  }
  cursor.t_enter = t_enter;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cursor.cell[axis] = locate(axis, t_enter, finest_per_top, 0, size_[axis], walk_starts);
  }
  cursor.stage = Cursor::Stage::directory;
  return true;
}

bool Walk::step(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Cursor& cursor,
                const TraversalOptions& options, Operations& operations) const {
  switch (cursor.stage) {
    case Cursor::Stage::directory:
      return read_directory(ray, record, cursor, options, operations);
    case Cursor::Stage::brick:
      ++operations.brick_reads;
      read_brick(record, cursor);
      return next_record(ray, cursor, operations);
    case Cursor::Stage::sheet:
      ++operations.brick_reads;
      return read_sheet(record, cursor) || leave_occupied(ray, cursor, operations);
    case Cursor::Stage::block:
      return test(ray, sheared, record, cursor, operations);
    case Cursor::Stage::start:
    case Cursor::Stage::left:
    case Cursor::Stage::finished:
      break;
  }
  expect(false, "a walk that steps is under way");
  return false;
}

bool Walk::read_directory(const Ray& ray, const std::byte* record, Cursor& cursor, const TraversalOptions& options,
                          Operations& operations) const {
  const auto entry = directory_entry(record, cursor.cell);
  if (!entry.empty()) {
    cursor.path[0] = {.brick = entry.brick()};
    cursor.stage = Cursor::Stage::brick;
    return true;
  }
  const std::int32_t reach = options.skip_empty_space ? entry.radius() * finest_per_top : finest_per_top;
  Corner low, high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::max(0, cursor.cell[axis] - reach + finest_per_top);
    high[axis] = std::min(size_[axis], cursor.cell[axis] + reach);
  }
  return leave_box(ray, low, high, cursor, operations);
}

/// Enters the brick path[level]: its voxels are the cells of the next level.
void Walk::read_brick(const std::byte* record, Cursor& cursor) const {
  Cursor::Level& level = cursor.path[cursor.level];
  level.occupied = read<Brick>(record).occupied;
  const std::int32_t edge = span_of(cursor.level), span = span_of(cursor.level + 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t low = cursor.cell[axis], high = low + edge;
    if (cursor.arrived) {
      cursor.cell[axis] = cursor.arrival[axis] & -span;
    } else if (axis == cursor.entry_axis) {
      cursor.cell[axis] = step_[axis] > 0 ? low : high - span;
    } else {
      cursor.cell[axis] = locate(axis, cursor.t_enter, span, low, high, cursor.entry_axis);
    }
  }
  ++cursor.level;
}

/// Reads what the current voxel holds in one sheet: a nested brick to enter, or blocks to be tested; false if it is done with.
bool Walk::read_sheet(const std::byte* record, Cursor& cursor) const {
  const auto brick = read<Brick>(record);
  Cursor::Level& level = cursor.path[cursor.level - 1];
  const int bit = voxel_bit(cursor.cell, cursor.level);
  const std::byte* addresses = record + sizeof(Brick);
  if (has(brick.nested, bit)) {
    const std::size_t child = brick.block_count + static_cast<std::size_t>(rank(brick.nested, bit));
    cursor.path[cursor.level] = {.brick = read<Address>(addresses + child * sizeof(Address))};
    cursor.stage = Cursor::Stage::brick;
    return true;
  }
  const std::size_t links = brick.block_count + static_cast<std::size_t>(std::popcount(brick.nested));
  const std::byte* masks = addresses + links * sizeof(Address);
  auto todo = static_cast<std::uint8_t>(0);
  if (has(brick.occupied, bit)) {
    todo = static_cast<std::uint8_t>(masks[rank(brick.occupied & ~brick.nested, bit)]);
  }
  if (cursor.sheet == level.brick) {  // only the first sheet's tests are remembered: the others are rare
    todo = static_cast<std::uint8_t>(todo & ~level.tested);
    level.tested = static_cast<std::uint8_t>(level.tested | todo);
  }
  cursor.block_count = 0;
  for (std::uint32_t rest = todo; rest != 0; rest &= rest - 1) {
    const auto block = static_cast<std::size_t>(std::countr_zero(rest));
    cursor.blocks[cursor.block_count++] = read<Address>(addresses + block * sizeof(Address));
  }
  cursor.sheet = brick.next_sheet;
  cursor.stage = cursor.block_count > 0 ? Cursor::Stage::block : Cursor::Stage::sheet;
  return cursor.block_count > 0 || cursor.sheet != no_address;
}

bool Walk::test(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Cursor& cursor,
                Operations& operations) const {
  const Address block = cursor.blocks[--cursor.block_count];
  test_block(ray, sheared, record, block, cursor.best, operations);
  if (ray.kind == RayKind::shadow && cursor.best.found()) {
    return false;
  }
  if (cursor.block_count > 0) {
    return true;
  }
  if (cursor.sheet != no_address) {
    cursor.stage = Cursor::Stage::sheet;
    return true;
  }
  return leave_occupied(ray, cursor, operations);
}

/// Leaves the current cell, or a box of empty ones around it, for the next cell on the same or a coarser level; false if the walk
/// ends.
bool Walk::leave_box(const Ray& ray, const Corner& low, const Corner& high, Cursor& cursor, Operations& operations) const {
  ++operations.cell_steps;
  const std::int32_t span = span_of(cursor.level);
  std::size_t exit_axis = 0;
  double t_exit = never;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double t = plane(axis, step_[axis] > 0 ? high[axis] : low[axis]);
    if (t < t_exit) {
      t_exit = t;
      exit_axis = axis;
    }
  }
  // At equality the next cell may hold the same t with a lower id.
  if (double{cursor.best.t} < t_exit || t_exit >= double{ray.t_max}) {
    return false;
  }
  const Corner before = cursor.cell;
  cursor.t_enter = t_exit;
  cursor.entry_axis = static_cast<std::uint8_t>(exit_axis);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis == exit_axis) {
      cursor.cell[axis] = step_[axis] > 0 ? high[axis] : low[axis] - 1;
    } else if (high[axis] - low[axis] > span) {  // a box of empty cells
      cursor.cell[axis] = locate(axis, t_exit, span, low[axis], high[axis], cursor.entry_axis);
    }
  }
  const std::int32_t now = cursor.cell[exit_axis];
  if (now < 0 || now >= size_[exit_axis]) {
    return false;
  }
  // Out of the brick: back to the level on which the new cell has the old one's parent.
  while (cursor.level > 0 && ((before[exit_axis] ^ now) & -span_of(cursor.level - 1)) != 0) {
    --cursor.level;
  }
  for (std::int32_t& corner : cursor.cell) {
    corner &= -span_of(cursor.level);
  }
  cursor.arrived = false;
  return whole_ || stays(cursor, now);
}

void Walk::leave_region(const Ray& ray, Cursor& cursor, Operations& operations) const {
  cursor.level = finest_level;
  cursor.cell = cursor.arrival;
  leave_box(ray, region_.low, region_.high, cursor, operations);
}

/// The finest cell that the ray enters with the cursor's cell, through the plane beside finest index `face` of the entry axis.
Corner Walk::finest_cell_of(const Cursor& cursor, std::int32_t face) const {
  const std::int32_t span = span_of(cursor.level);
  Corner finest;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t low = cursor.cell[axis];
    finest[axis] = axis == cursor.entry_axis ? face : locate(axis, cursor.t_enter, 1, low, low + span, cursor.entry_axis);
  }
  return finest;
}

/// Whether the cell just entered is this region's; if not, notes where the ray has gone.
bool Walk::stays(Cursor& cursor, std::int32_t face) const {
  if (region_.contains(cursor.cell, span_of(cursor.level))) {
    return true;
  }
  cursor.arrival = finest_cell_of(cursor, face);
  if (region_.contains(cursor.arrival)) {
    return true;
  }
  cursor.stage = Cursor::Stage::left;
  return false;
}

Corner Walk::first_cell(const Cursor& cursor) const { return finest_cell_of(cursor, 0); }

/// Leaves a cell whose records have been read: one that the region's border cuts is left at the border.
bool Walk::leave_occupied(const Ray& ray, Cursor& cursor, Operations& operations) const {
  Corner low = cursor.cell, high = cursor.cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    high[axis] = std::min(low[axis] + span_of(cursor.level), region_.high[axis]);
    low[axis] = std::max(low[axis], region_.low[axis]);
  }
  return leave_box(ray, low, high, cursor, operations) && next_record(ray, cursor, operations);
}

bool Walk::leave_cell(const Ray& ray, Cursor& cursor, Operations& operations) const {
  Corner high = cursor.cell;
  for (std::int32_t& corner : high) {
    corner += span_of(cursor.level);
  }
  return leave_box(ray, cursor.cell, high, cursor, operations);
}

/// From a cell that has just been entered: passes empty voxels until a record is needed.
bool Walk::next_record(const Ray& ray, Cursor& cursor, Operations& operations) const {
  while (cursor.level > 0) {
    const Cursor::Level& level = cursor.path[cursor.level - 1];
    if (has(level.occupied, voxel_bit(cursor.cell, cursor.level))) {
      cursor.sheet = level.brick;
      cursor.stage = Cursor::Stage::sheet;
      return true;
    }
    if (!leave_cell(ray, cursor, operations)) {
      return false;
    }
  }
  cursor.stage = Cursor::Stage::directory;
  return true;
}

Address record_needed(const Cursor& cursor, const DatabaseHeader& header) {
  switch (cursor.stage) {
    case Cursor::Stage::directory:
      return directory_address(header, cursor.cell);
    case Cursor::Stage::brick:
      return cursor.path[cursor.level].brick;
    case Cursor::Stage::sheet:
      return cursor.sheet;
    default:
      return cursor.blocks[cursor.block_count - 1U];
  }
}

}  // namespace dmpc::core
