// Up to 16 rays that walk together through a database in which meshes are kept once.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// A RayBundle, and where it is within a mesh: by value, so that pages may leave. In a mesh `waiting`, `next` and `next_rays` are
/// of its tree. Not initialised.
struct InstanceBundle : RayBundle {
  /// Rays as the boxes of one tree need them: rows of a RayBundle.
  struct BoxRows {
    alignas(64) std::array<Row<float>, 3> origin, reciprocal;
    std::array<std::uint32_t, 3> near_row, far_row;
    bool is_one_octant;
  };

  bool is_inside;  ///< of the mesh of `instance`: the rest is known
  InstanceRecord instance;
  Address instance_address;
  double mesh_pad;  ///< how far in front of a box, and behind it, a ray may be for it to count, in the mesh's records' units
  BoxRows in_mesh;  ///< of the rays that are inside
  BundleChildren outside;  ///< what waits outside meanwhile

  /// Those of `next_rays` go into a mesh: `next` is its first BVH node.
  void enter(const InstanceRecord& record, Address address, const GridFrame& frame);
  /// What waits outside is what waits.
  void leave_mesh();
  /// Puts the rows of the mesh in the place of the grid's, or back.
  void swap_rows();
  /// Those instances of a leaf come to wait whose boxes some of `next_rays` meet.
  void meet_instances(const std::byte* leaf, bool in_order);
};
static_assert(std::is_trivially_copyable_v<InstanceBundle>);

/// The BVH node with boxes as much larger on all sides as `pad`, or more.
BvhNode padded(const BvhNode& bvh_node, double pad);

}  // namespace dmpc::core
