// A ray's traversal of a database with instances: boxes are tested in the mesh's coordinates, triangles in the grid's.
#pragma once

#include <algorithm>
#include <optional>
#include <type_traits>

#include "core/record/instance.h"
#include "core/record/records.h"
#include "core/trace/cursor.h"
#include "core/trace/kernel.h"
#include "core/trace/mesh_ray.h"
#include "core/trace/placed_leaf.h"
#include "core/trace/traversal.h"

namespace dmpc::core {

/// A Cursor and its state within a mesh, all by value, since pages may be evicted. In the grid an InstanceRecord is a child like
/// others.
struct InstanceCursor : Cursor {
  bool is_inside = false;  ///< the fields below are set, for the instance at `next`
  InstanceRecord instance;
  MeshRay ray;
  BvhChild next_in_mesh = BvhChild::none();
  MetChildren waiting_in_mesh;
};
static_assert(std::is_trivially_copyable_v<InstanceCursor>);

/// One ray's traversal, as RayTraversal. Boxes decide which leaves of a mesh are visited, never what is hit: a leaf that is
/// reached is placed, corner by corner, and tested as its copy would be. So t, id and what follows from them have the copy's
/// bits.
template <Records R>
class InstanceTraversal {
 public:
  InstanceTraversal(const Ray& ray, InstanceCursor& cursor, R& records, const DatabaseHeader& header, Operations& operations)
      : ray_(ray), sheared_(ray), cursor_(cursor), records_(records), header_(header), operations_(operations) {}

  Traced trace(const Skips& skips) {
    return RayTraversal(ray_, cursor_, records_, operations_).walk_cells(header_, skips, [this](const BoxRay& box, bool any) {
      return visit_children(box, any);
    });
  }

  /// Traverses the mesh that the cursor is in. False if a record is absent.
  bool visit_mesh(bool any) {
    const auto t_low = static_cast<float>(cursor_.t_enter), t_high = std::min(static_cast<float>(cursor_.exit.t), ray_.t_max);
    for (BvhChild child = cursor_.next_in_mesh; child.found();) {
      cursor_.next_in_mesh = child;
      const std::byte* const record = find(child.address());
      if (record == nullptr) {
        return false;
      }
      if (child.is_leaf()) {
        test_placed(record, child.address());
        if (any && cursor_.best.found()) {
          return true;
        }
        child = BvhChild::none();
      } else {
        ++operations_.bvh_node_reads;
        child = cursor_.ray.meet(*reinterpret_cast<const BvhNode*>(record), t_low, std::min(t_high, cursor_.best.t), !any,
                                 cursor_.waiting_in_mesh);
      }
      if (!child.found()) {
        child = cursor_.waiting_in_mesh.take_up_to(cursor_.best.t);
      }
    }
    return true;
  }

 private:
  const std::byte* find(Address address) {
    const std::byte* const record = records_.find(address);
    if (record == nullptr) {
      cursor_.absent = address;
    }
    return record;
  }

  bool visit_children(const BoxRay& box, bool any) {
    const auto t_low = static_cast<float>(cursor_.t_enter), t_high = std::min(static_cast<float>(cursor_.exit.t), ray_.t_max);
    for (BvhChild child = cursor_.next; child.found();) {
      cursor_.next = child;
      if (!cursor_.is_inside) {
        const std::byte* const record = find(child.address());
        if (record == nullptr) {
          return false;
        }
        child = visit(child, record, box, t_low, t_high, any);
      }
      if (cursor_.is_inside) {
        if (!visit_mesh(any)) {
          return false;
        }
        cursor_.is_inside = false;
        child = BvhChild::none();
      }
      if (any && cursor_.best.found()) {
        operations_.skipped.any_hit += count_before(cursor_.waiting, cursor_.best);
        break;
      }
      if (!child.found()) {
        child = cursor_.waiting.take_up_to(cursor_.best.t);
      }
    }
    return true;
  }

  /// Handles a child. Returns the child below it that comes next, if there is one.
  BvhChild visit(BvhChild child, const std::byte* record, const BoxRay& box, float t_low, float t_high, bool any) {
    const float t_most = std::min(t_high, cursor_.best.t);
    if (!child.is_leaf()) {
      ++operations_.bvh_node_reads;
      return meet_children(box, *reinterpret_cast<const BvhNode*>(record), t_low, t_most, !any, cursor_.waiting);
    }
    const auto header = read<LeafHeader>(record);
    if (header.kind != PrimitiveKind::instance) {
      core::test_leaf(ray_, sheared_, record, child.address(), cursor_.best, operations_);
      return BvhChild::none();
    }
    if (!is_instance(header)) {
      ++operations_.bvh_node_reads;
      return meet_instances(record, box, t_low, t_most, !any);
    }
    ++operations_.instance_entries;
    enter(read<InstanceRecord>(record));
    return BvhChild::none();
  }

  /// Adds those of a leaf whose boxes the ray meets to the waiting children.
  BvhChild meet_instances(const std::byte* record, const BoxRay& box, float t_low, float t_high, bool in_order) {
    const auto header = read<LeafHeader>(record);
    const std::size_t count = header.count;
    const auto* rows = reinterpret_cast<const float*>(record + sizeof(header));
    const std::uint32_t first = cursor_.waiting.count;
    for (std::size_t lane = 0; lane < count; ++lane) {
      float enter = t_low, leave = t_high;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto plane = [&](std::size_t row) { return (rows[row * count + lane] - box.origin[axis]) * box.reciprocal[axis]; };
        enter = std::max(enter, plane(box.near_row[axis]));
        leave = std::min(leave, plane(box.far_row[axis]));
      }
      if (enter <= leave) {
        cursor_.waiting.add(BvhChild::leaf(instance_in(record, lane)), enter, in_order ? first : cursor_.waiting.count);
      }
    }
    return cursor_.waiting.count > first ? cursor_.waiting.take() : BvhChild::none();
  }

  void enter(const InstanceRecord& instance) {
    cursor_.instance = instance;
    cursor_.ray = MeshRay(ray_, instance, header_.frame);
    cursor_.next_in_mesh = BvhChild::bvh_node(instance.root);
    cursor_.waiting_in_mesh.count = 0;
    cursor_.waiting_in_mesh.t_taken = cursor_.waiting.t_taken;
    cursor_.is_inside = true;
    instance_.reset();
  }

  void test_placed(const std::byte* record, Address leaf) {
    if (!instance_) {
      instance_.emplace(cursor_.instance, header_.frame);
    }
    PlacedLeaf placed;
    operations_.placed_triangles += placed.place(record, *instance_);
    Hit best = test(placed, leaf);
    if (is_new(best) && placed.has_vanished(best.lane)) {
      placed.take_vanished_away();
      best = test(placed, leaf);
    }
    if (is_new(best)) {
      best.lane = lane_in_instance(best.lane, cursor_.next.address());
      cursor_.best = best;
    }
  }

  Hit test(const PlacedLeaf& placed, Address leaf) {
    Hit best = cursor_.best;
    core::test_leaf(ray_, sheared_, placed.record(), leaf, best, operations_);
    return best;
  }
  /// False if it is the known hit, whose record's address this node did not know.
  bool is_new(const Hit& hit) const {
    return hit.t != cursor_.best.t || hit.primitive != cursor_.best.primitive || hit.leaf != cursor_.best.leaf;
  }

  const Ray& ray_;
  const ShearedRay sheared_;
  InstanceCursor& cursor_;
  R& records_;
  const DatabaseHeader& header_;
  Operations& operations_;
  std::optional<PlacedMesh> instance_;  ///< the instance that the ray is in, once one of its leaves is placed
};

/// trace() for a database with instances.
template <Records R>
Traced trace(const Ray& ray, InstanceCursor& cursor, R& records, const DatabaseHeader& header, const Skips& skips,
             Operations& operations) {
  return InstanceTraversal<R>(ray, cursor, records, header, operations).trace(skips);
}

}  // namespace dmpc::core
