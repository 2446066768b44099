// trace(ray, cursor, records): hit, miss, or absent record r; resumable at every record, with the same bits.
#pragma once

#include <algorithm>
#include <optional>

#include "core/record/directory.h"
#include "core/record/records.h"
#include "core/trace/kernel.h"
#include "core/trace/walk.h"

namespace dmpc::core {

enum class Traced : std::uint8_t { hit, miss, absent, left };

/// The answer of a walk that has ended or has left its region.
inline Traced finish(Cursor& cursor) {
  if (cursor.stage == Cursor::Stage::left) {
    return Traced::left;
  }
  cursor.stage = Cursor::Stage::finished;
  return cursor.best.found() ? Traced::hit : Traced::miss;
}

/// Where the ray goes on, after Traced::left.
inline Passage passage_of(const Cursor& cursor) { return {cursor.t_enter, cursor.arrival, cursor.entry_axis, cursor.best}; }

/// The cursor of a walk that enters a region.
inline Cursor arrive(const Passage& passage) {
  Cursor cursor;
  cursor.best = passage.best;
  cursor.t_enter = passage.t_enter;
  cursor.entry_axis = passage.entry_axis;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cursor.cell[axis] = passage.cell[axis] & -finest_per_top;
  }
  cursor.stage = Cursor::Stage::directory;
  return cursor;
}

/// Where a ray's walk begins; nothing if it misses the grid.
inline std::optional<Passage> first_passage(const Ray& ray, const GridFrame& frame) {
  const Walk walk(ray, frame, {.high = grid_size(frame)});
  Cursor cursor;
  if (!walk.enter(ray, cursor)) {
    return std::nullopt;
  }
  return Passage{.t_enter = cursor.t_enter, .cell = walk.first_cell(cursor)};
}

/// What trace() would answer from `passage` on in the walk's region if that had no records, without reading any. After
/// Traced::left `passage` is where the ray goes on, else where it was.
inline Traced pass(const Ray& ray, const Walk& walk, Passage& passage, Operations& operations) {
  Cursor cursor = arrive(passage);
  walk.leave_region(ray, passage.cell, cursor, operations);
  const Traced traced = finish(cursor);
  if (traced == Traced::left) {
    passage = passage_of(cursor);
  }
  return traced;
}

/// Passes through a region by itself.
inline Traced pass(const Ray& ray, const GridFrame& frame, const Region& region, Passage& passage, Operations& operations) {
  return pass(ray, Walk(ray, frame, region), passage, operations);
}

/// Where the ray enters the first box of a block in the cursor's cell, from cursor.next on; infinite if it meets none. Reads
/// bricks alone.
template <Records R>
float first_block_in_cell(const Ray& ray, const BoxRay& box, Cursor& cursor, R& records, Operations& operations) {
  const auto t_low = static_cast<float>(cursor.t_enter);
  const float t_high = std::min({static_cast<float>(cursor.exit.t), ray.t_max, cursor.best.t});
  float first = std::numeric_limits<float>::infinity();
  for (BrickChild child = cursor.next; child.found();) {
    if (child.is_block()) {
      first = std::min(first, cursor.waiting.t_taken);
      child = BrickChild::none();
    } else {
      ++operations.brick_reads;
      const auto& brick = *reinterpret_cast<const Brick*>(records.find(child.address()));
      child = meet_children(box, brick, t_low, std::min(t_high, first), true, cursor.waiting);
    }
    if (!child.found()) {
      child = cursor.waiting.take_up_to(first);
    }
  }
  return first;
}

/// Where the ray, from `passage` on, enters the first box of a block of the database, a float no greater than trace() could tell;
/// infinite if trace() would test no primitive any more. `records` never says absent.
template <Records R>
float first_block(const Ray& ray, const BoxRay& box, const Walk& walk, const Passage& passage, R& records,
                  const DatabaseHeader& header, const Skips& skips, Operations& operations) {
  Cursor cursor = arrive(passage);
  for (bool goes_on = true; goes_on;) {
    if (cursor.stage == Cursor::Stage::directory) {
      const std::uint64_t index = directory_index(header, cursor.cell);
      const std::byte* const record = records.find(directory_address(header, index));
      goes_on = walk.read(ray, read<DirectoryEntry>(record + directory_offset(index)), cursor, skips, operations);
    } else if (const float first = first_block_in_cell(ray, box, cursor, records, operations);
               first < std::numeric_limits<float>::infinity()) {
      return first;
    } else {
      goes_on = walk.leave_cell(ray, cursor, operations);
    }
  }
  return std::numeric_limits<float>::infinity();
}

/// Children that wait and do not lie behind the hit.
inline std::uint64_t count_before(const MetChildren& waiting, const Hit& hit) {
  const auto begin = waiting.t_enter.begin();
  return static_cast<std::uint64_t>(std::count_if(begin, begin + waiting.count, [&](float t) { return t <= hit.t; }));
}

/// Visits the children of the cursor's cell that the ray meets, from cursor.next on: `meet` finds them, `test(record, address,
/// best)` is called for blocks. False if a record is absent. `any` hit will do: it ends the visit.
template <Records R, class Test>
bool visit_children(const Ray& ray, const BoxRay& box, bool any, Cursor& cursor, R& records, Operations& operations,
                    BrickKernel meet, const Test& test) {
  const auto t_low = static_cast<float>(cursor.t_enter), t_high = std::min(static_cast<float>(cursor.exit.t), ray.t_max);
  for (BrickChild child = cursor.next; child.found();) {
    cursor.next = child;
    const Address address = child.address();
    const std::byte* record = records.find(address);
    if (record == nullptr) {
      cursor.absent = address;
      return false;
    }
    if (child.is_block()) {
      test(record, address, cursor.best);
      if (any && cursor.best.found()) {
        operations.skipped.any_hit += count_before(cursor.waiting, cursor.best);
        break;
      }
      child = BrickChild::none();
    } else {
      ++operations.brick_reads;
      const auto& brick = *reinterpret_cast<const Brick*>(record);
      child = meet(box, brick, t_low, std::min(t_high, cursor.best.t), !any, cursor.waiting);
    }
    if (!child.found()) {
      child = cursor.waiting.take_up_to(cursor.best.t);
    }
  }
  return true;
}

/// trace() with kernels of one's own.
template <Records R, class Test>
Traced trace_blocks(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const Skips& skips,
                    Operations& operations, BrickKernel meet, const Test& test) {
  if (cursor.stage == Cursor::Stage::finished) {
    return finish(cursor);
  }
  const Walk walk(ray, header.frame, header.region);
  if (cursor.stage == Cursor::Stage::start && !walk.enter(ray, cursor)) {
    return finish(cursor);
  }
  const BoxRay box(ray, walk.reciprocal());
  const bool any = skips.any_hit && ray.kind == RayKind::shadow;
  for (;;) {
    if (cursor.stage == Cursor::Stage::directory) {
      const std::uint64_t index = directory_index(header, cursor.cell);
      const Address address = directory_address(header, index);
      const std::byte* record = records.find(address);
      if (record == nullptr) {
        cursor.absent = address;
        return Traced::absent;
      }
      if (!walk.read(ray, read<DirectoryEntry>(record + directory_offset(index)), cursor, skips, operations)) {
        return finish(cursor);
      }
    } else if (!visit_children(ray, box, any, cursor, records, operations, meet, test)) {
      return Traced::absent;
    } else if ((any && cursor.best.found()) || !walk.leave_cell(ray, cursor, operations)) {
      return finish(cursor);
    }
  }
}

/// Walks `ray` through the grid until its nearest hit in (0, ray.t_max) is known (for a shadow ray: any hit, unless
/// that skip is off), no hit can exist, or a record is absent. After Traced::absent, call again with the same cursor once the
/// record of cursor.absent is there: the answer has the same bits as without the interruption. Where `header` is a region's, a
/// ray that leaves the region answers Traced::left, and whoever owns the cell of passage_of(cursor) goes on from arrive(), with
/// the same bits. A ray with a NaN or an infinite component misses. Source: J. Amanatides, A. Woo, "A Fast Voxel Traversal
/// Algorithm for Ray Tracing", 1987.
template <Records R>
Traced trace(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const Skips& skips,
             Operations& operations) {
  const ShearedRay sheared(ray);
  return trace_blocks(
      ray, cursor, records, header, skips, operations, meet_children,
      [&](const std::byte* record, Address address, Hit& best) { test_block(ray, sheared, record, address, best, operations); });
}

}  // namespace dmpc::core
