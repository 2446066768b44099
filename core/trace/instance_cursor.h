// Where a ray is on its way through a database in which meshes are kept once.
#pragma once

#include <type_traits>

#include "core/record/instance.h"
#include "core/trace/cursor.h"
#include "core/trace/mesh_ray.h"

namespace dmpc::core {

/// A Cursor, and where it is within a mesh: by value, so that pages may leave. In the grid an InstanceRecord is a child like
/// others.
struct InstanceCursor : Cursor {
  bool is_inside = false;  ///< the rest is known: of the instance at `next`
  InstanceRecord instance;
  MeshRay ray;
  BrickChild next_in_mesh = BrickChild::none();
  MetChildren waiting_in_mesh;
};
static_assert(std::is_trivially_copyable_v<InstanceCursor>);

}  // namespace dmpc::core
