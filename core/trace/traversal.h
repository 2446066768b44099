// trace(ray, cursor, records): hit, miss, or absent record r; resumable at every record, with the same bits.
#pragma once

#include <algorithm>
#include <optional>

#include "core/record/directory.h"
#include "core/record/records.h"
#include "core/trace/cell_traversal.h"
#include "core/trace/kernel.h"

namespace dmpc::core {

enum class Traced : std::uint8_t { hit, miss, absent, left };

/// The result of a traversal that has ended or has left its region.
inline Traced finish(Cursor& cursor) {
  if (cursor.stage == Cursor::Stage::left) {
    return Traced::left;
  }
  cursor.stage = Cursor::Stage::finished;
  return cursor.best.found() ? Traced::hit : Traced::miss;
}

/// Where the ray goes on, after Traced::left.
inline Passage passage_of(const Cursor& cursor) { return {cursor.t_enter, cursor.arrival, cursor.entry_axis, cursor.best}; }

/// The cursor of a traversal that enters a region.
inline Cursor arrive(const Passage& passage) {
  Cursor cursor;
  cursor.best = passage.best;
  cursor.t_enter = passage.t_enter;
  cursor.entry_axis = passage.entry_axis;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cursor.cell[axis] = passage.cell[axis] & -finest_per_macro;
  }
  cursor.stage = Cursor::Stage::directory;
  return cursor;
}

/// Where a ray's traversal begins; nothing if it misses the grid.
inline std::optional<Passage> first_passage(const Ray& ray, const GridFrame& frame) {
  const CellTraversal walk(ray, frame, {.high = grid_size(frame)});
  Cursor cursor;
  if (!walk.enter(ray, cursor)) {
    return std::nullopt;
  }
  return Passage{.t_enter = cursor.t_enter, .cell = walk.first_cell(cursor)};
}

/// What trace() would return from `passage` on if the traversal's region had no records, without reading any. After Traced::left
/// `passage` is where the ray goes on; otherwise it is unchanged.
inline Traced pass(const Ray& ray, const CellTraversal& walk, Passage& passage, Operations& operations) {
  Cursor cursor = arrive(passage);
  walk.leave_region(ray, passage.cell, cursor, operations);
  const Traced traced = finish(cursor);
  if (traced == Traced::left) {
    passage = passage_of(cursor);
  }
  return traced;
}

/// Passes through one region.
inline Traced pass(const Ray& ray, const GridFrame& frame, const Region& region, Passage& passage, Operations& operations) {
  return pass(ray, CellTraversal(ray, frame, region), passage, operations);
}

/// Number of waiting children that do not lie behind the hit.
inline std::uint64_t count_before(const MetChildren& waiting, const Hit& hit) {
  const auto begin = waiting.t_enter.begin();
  return static_cast<std::uint64_t>(std::count_if(begin, begin + waiting.count, [&](float t) { return t <= hit.t; }));
}

/// One ray's traversal over one kind of records. The constructor's arguments outlive it. Not thread-safe; costs nothing to make.
template <Records R>
class RayTraversal {
 public:
  RayTraversal(const Ray& ray, Cursor& cursor, R& records, Operations& operations)
      : ray_(ray), cursor_(cursor), records_(records), operations_(operations) {}

  /// trace() with the caller's kernels: `meet` finds the children of a BVH node that the ray meets, test(record, address, best)
  /// is called for leaves.
  template <class Test>
  Traced trace(const DatabaseHeader& header, const Skips& skips, BvhNodeKernel meet, const Test& test) {
    return walk_cells(header, skips, [&](const BoxRay& box, bool any) {
      return header.has_voxels() ? visit_list(header, any, test) : visit_children(box, any, meet, test);
    });
  }

  /// trace() with the caller's visit of a macro cell: visit(box, any) goes on from cursor.next, and is false if a record is
  /// absent.
  template <class Visit>
  Traced walk_cells(const DatabaseHeader& header, const Skips& skips, const Visit& visit) {
    if (cursor_.stage == Cursor::Stage::finished) {
      return finish(cursor_);
    }
    const CellTraversal walk(ray_, header.frame, header.region);
    if (cursor_.stage == Cursor::Stage::start && !walk.enter(ray_, cursor_)) {
      return finish(cursor_);
    }
    const BoxRay box(ray_, walk.reciprocal());
    const bool any = skips.any_hit && ray_.kind == RayKind::shadow;
    for (;;) {
      if (cursor_.stage == Cursor::Stage::directory) {
        const std::uint64_t index = directory_index(header, cursor_.cell);
        const Address address = directory_address(header, index);
        const std::byte* record = records_.find(address);
        if (record == nullptr) {
          cursor_.absent = address;
          return Traced::absent;
        }
        if (!walk.read(ray_, read<DirectoryEntry>(record + directory_offset(index)), cursor_, operations_)) {
          return finish(cursor_);
        }
      } else if (!visit(box, any)) {
        return Traced::absent;
      } else if ((any && cursor_.best.found()) || !walk.leave_cell(ray_, cursor_, operations_)) {
        return finish(cursor_);
      }
    }
  }

  /// Visits the children of the cursor's cell that the ray meets, from cursor.next on. False if a record is absent. `any`: any
  /// hit ends the visit.
  template <class Test>
  bool visit_children(const BoxRay& box, bool any, BvhNodeKernel meet, const Test& test) {
    const auto t_low = static_cast<float>(cursor_.t_enter), t_high = std::min(static_cast<float>(cursor_.exit.t), ray_.t_max);
    for (BvhChild child = cursor_.next; child.found();) {
      cursor_.next = child;
      const Address address = child.address();
      const std::byte* record = records_.find(address);
      if (record == nullptr) {
        cursor_.absent = address;
        return false;
      }
      if (child.is_leaf()) {
        test(record, address, cursor_.best);
        if (any && cursor_.best.found()) {
          operations_.skipped.any_hit += count_before(cursor_.waiting, cursor_.best);
          break;
        }
        child = BvhChild::none();
      } else {
        ++operations_.bvh_node_reads;
        const auto& bvh_node = *reinterpret_cast<const BvhNode*>(record);
        child = meet(box, bvh_node, t_low, std::min(t_high, cursor_.best.t), !any, cursor_.waiting);
      }
      if (!child.found()) {
        child = cursor_.waiting.take_up_to(cursor_.best.t);
      }
    }
    return true;
  }

  /// Tests the leaves in the list of the cursor's voxel, from cursor.next on: a leaf, or, stored like a BVH node's address, the
  /// number of a reference. What follows a leaf is kept in a waiting child's slot. False if a record is absent.
  template <class Test>
  bool visit_list(const DatabaseHeader& header, bool any, const Test& test) {
    BvhChild& behind = cursor_.waiting.record[0];
    for (BvhChild item = cursor_.next; item.found();) {
      cursor_.next = item;
      const Address address = item.is_leaf() ? item.address() : reference_address(header, item.bits);
      const std::byte* const record = records_.find(address);
      if (record == nullptr) {
        cursor_.absent = address;
        return false;
      }
      if (!item.is_leaf()) {
        const auto reference = read<VoxelReference>(record + reference_offset(item.bits));
        behind = reference.is_last() ? BvhChild::none() : BvhChild{item.bits + 1};
        item = BvhChild::leaf(reference.leaf());
        continue;
      }
      test(record, address, cursor_.best);
      if (any && cursor_.best.found()) {
        operations_.skipped.any_hit += behind.found() ? 1 : 0;
        break;
      }
      item = behind;
    }
    return true;
  }

  /// The t at which the ray, from the cursor's arrival on, enters the first box of a leaf of the database, or the first voxel
  /// with a list: a float no greater than trace() could find; infinite if trace() would test no more primitives. No record may be
  /// absent, and no list is read.
  float first_leaf(const CellTraversal& walk, const DatabaseHeader& header) {
    const BoxRay box(ray_, walk.reciprocal());
    for (bool goes_on = true; goes_on;) {
      if (cursor_.stage == Cursor::Stage::directory) {
        const std::uint64_t index = directory_index(header, cursor_.cell);
        const std::byte* const record = records_.find(directory_address(header, index));
        goes_on = walk.read(ray_, read<DirectoryEntry>(record + directory_offset(index)), cursor_, operations_);
      } else if (header.has_voxels()) {
        return static_cast<float>(cursor_.t_enter);
      } else if (const float first = first_block_in_cell(box); first < never) {
        return first;
      } else {
        goes_on = walk.leave_cell(ray_, cursor_, operations_);
      }
    }
    return never;
  }

 private:
  static constexpr float never = std::numeric_limits<float>::infinity();

  /// From cursor.next on. Reads only BVH nodes.
  float first_block_in_cell(const BoxRay& box) {
    const auto t_low = static_cast<float>(cursor_.t_enter);
    const float t_high = std::min({static_cast<float>(cursor_.exit.t), ray_.t_max, cursor_.best.t});
    float first = never;
    for (BvhChild child = cursor_.next; child.found();) {
      if (child.is_leaf()) {
        first = std::min(first, cursor_.waiting.t_taken);
        child = BvhChild::none();
      } else {
        ++operations_.bvh_node_reads;
        const auto& bvh_node = *reinterpret_cast<const BvhNode*>(records_.find(child.address()));
        child = meet_children(box, bvh_node, t_low, std::min(t_high, first), true, cursor_.waiting);
      }
      if (!child.found()) {
        child = cursor_.waiting.take_up_to(first);
      }
    }
    return first;
  }

  const Ray& ray_;
  Cursor& cursor_;
  R& records_;
  Operations& operations_;
};

/// Traverses the grid with `ray` until its nearest hit in (0, ray.t_max) is known (for a shadow ray: any hit, unless that skip is
/// off), no hit can exist, or a record is absent. After Traced::absent, call again with the same cursor once the record of
/// cursor.absent is present: the answer has the same bits as without the interruption. Where `header` is a region's, a ray that
/// leaves the region returns Traced::left, and the owner of the cell of passage_of(cursor) goes on from arrive(), with the same
/// bits. A ray with a NaN or an infinite component misses. Source: J. Amanatides, A. Woo, "A Fast Voxel Traversal Algorithm for
/// Ray Tracing", 1987.
template <Records R>
Traced trace(const Ray& ray, Cursor& cursor, R& records, const DatabaseHeader& header, const Skips& skips,
             Operations& operations) {
  const ShearedRay sheared(ray);
  return RayTraversal(ray, cursor, records, operations)
      .trace(header, skips, meet_children, [&](const std::byte* record, Address address, Hit& best) {
        test_leaf(ray, sheared, record, address, best, operations);
      });
}

}  // namespace dmpc::core
