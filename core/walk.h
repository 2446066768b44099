// The walk of one ray through the nested grid, one record a step.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/cursor.h"
#include "core/operations.h"
#include "core/primitive.h"
#include "core/ray.h"
#include "core/record.h"

namespace dmpc::core {

/// What a caller may switch off to see what it contributes. Every switch is exact: it does not change a bit of the result.
struct TraversalOptions {
  bool skip_empty_space = true;  ///< leave empty boxes of top cells in one step
};

/// What a ray and a grid determine: nothing here is carried from step to step, everything is recomputed from the ray's bits.
///
/// The one formula for a plane anywhere: plane i of an axis (in finest cells) is crossed at t = i * slope + offset, in double.
/// Rounding keeps order, so t rises or falls with i without exception, and "which planes has the ray crossed at t" has one answer
/// on every level: the cells of all levels are projections of one sequence of finest cells, and leaving a box of empty cells in
/// one step leads to the same cell as leaving it cell by cell. Planes crossed at equal t are crossed in the order x, y, z.
class Walk {
 public:
  Walk(const Ray& ray, const GridFrame& frame, const Region& region);

  /// Puts the cursor on the first top cell; false if the ray misses the grid or is not finite.
  bool enter(const Ray& ray, Cursor& cursor) const;

  /// The finest cell that a walk which enter() has put on its first top cell starts in.
  Corner first_cell(const Cursor& cursor) const;

  /// Consumes the record of record_needed() and goes on to the next stage that needs one; false once the walk is finished, or has
  /// left the region (then cursor.stage says so).
  bool step(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Cursor& cursor, const TraversalOptions& options,
            Operations& operations) const;

  /// Takes a ray that has arrived in the region through all of it, as if nothing were there. The walk is then finished or has
  /// left.
  void leave_region(const Ray& ray, Cursor& cursor, Operations& operations) const;

 private:
  double plane(std::size_t axis, std::int32_t index) const;
  bool crossed(std::size_t axis, std::int32_t index, double t, std::uint8_t entry_axis) const;
  std::int32_t locate(std::size_t axis, double t, std::int32_t span, std::int32_t low, std::int32_t high,
                      std::uint8_t entry_axis) const;
  bool read_directory(const Ray& ray, const std::byte* record, Cursor& cursor, const TraversalOptions& options,
                      Operations& operations) const;
  void read_brick(const std::byte* record, Cursor& cursor) const;
  bool read_sheet(const std::byte* record, Cursor& cursor) const;
  bool test(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Cursor& cursor, Operations& operations) const;
  bool leave_box(const Ray& ray, const Corner& low, const Corner& high, Cursor& cursor, Operations& operations) const;
  bool leave_cell(const Ray& ray, Cursor& cursor, Operations& operations) const;
  bool leave_occupied(const Ray& ray, Cursor& cursor, Operations& operations) const;
  bool stays(Cursor& cursor, std::int32_t face) const;
  Corner finest_cell_of(const Cursor& cursor, std::int32_t face) const;
  bool next_record(const Ray& ray, Cursor& cursor, Operations& operations) const;

  Vec3d origin_, direction_;
  std::array<double, 3> slope_{}, offset_{};
  std::array<std::int32_t, 3> step_{};  ///< -1, 0 or +1
  Corner size_{};                       ///< of the grid, in finest cells
  Region region_;
  bool whole_;  ///< the region is the whole grid: nothing leaves it
  double finest_cell_;
};

/// The record that the next step reads. Requires a walk that has been entered and is not finished.
Address record_needed(const Cursor& cursor, const DatabaseHeader& header);

}  // namespace dmpc::core
