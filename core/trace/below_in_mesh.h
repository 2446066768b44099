// The part of a ray's traversal that another node does, for databases with instances: in a base mesh the instance is sent, too.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/base/expect.h"
#include "core/record/instance.h"
#include "core/trace/below.h"
#include "core/trace/instance_traversal.h"

namespace dmpc::core {

/// What a traversal in a base mesh needs from the InstanceRecord at `record`, in addition to a Below.
struct ReportedInstance {
  std::array<double, 12> world{};
  Address record = no_address;
  std::uint32_t first = 0;
  float unit = 1, pad = 0;
};
static_assert(sizeof(ReportedInstance) == 112 && std::is_trivially_copyable_v<ReportedInstance>);

/// Outside of meshes: below() of a Cursor.
inline Below below(const Ray& ray, const InstanceCursor& cursor, const Skips& skips) {
  return below(ray, cursor, cursor.is_inside ? cursor.next_in_mesh : cursor.next, skips);
}

/// The instance that the traversal is in.
inline ReportedInstance reported_instance(const InstanceCursor& cursor) {
  expect(cursor.is_inside, "a place is told of a traversal in a mesh");
  const InstanceRecord& instance = cursor.instance;
  return {instance.world, cursor.next.address(), instance.first, instance.unit, instance.pad};
}

/// trace_below() in a mesh.
template <Records R>
Hit trace_below(const Below& below, const ReportedInstance& place, R& records, const DatabaseHeader& header,
                Operations& operations) {
  const Ray ray = ray_of(below);
  auto cursor = cursor_of<InstanceCursor>(below);
  cursor.instance = {.world = place.world, .first = place.first, .unit = place.unit, .pad = place.pad};
  cursor.ray = MeshRay(ray, cursor.instance, header.frame);
  cursor.next = BvhChild::leaf(place.record);
  cursor.next_in_mesh = below.child;
  cursor.waiting_in_mesh.count = 0;
  cursor.is_inside = true;
  const bool visited = InstanceTraversal<R>(ray, cursor, records, header, operations).visit_mesh(below.any != 0);
  expect(visited, "whoever has a record of a mesh has all that is below it");
  return found_below(below, cursor);
}

/// Outside of meshes: take_below() of a Cursor.
inline void take_below(const Hit& found, const Ray& ray, const Skips& skips, InstanceCursor& cursor, Operations& operations) {
  if (!cursor.is_inside) {
    take_below(found, ray, skips, static_cast<Cursor&>(cursor), operations);
  } else if (take_found(found, ray, skips, cursor, operations)) {
    cursor.is_inside = false;
  } else {
    cursor.next_in_mesh = cursor.waiting_in_mesh.take_up_to(cursor.best.t);
  }
}

}  // namespace dmpc::core
