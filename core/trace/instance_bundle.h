// Up to 16 rays that traverse a database with instances together.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/record/instance.h"
#include "core/record/record.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// A RayBundle and its state within a mesh, all by value, since pages may be evicted. In a mesh `waiting`, `next` and `next_rays`
/// refer to its tree. Not initialised.
struct InstanceBundle : RayBundle {
  /// Rays as box tests in one tree need them: rows of a RayBundle.
  struct BoxRows {
    alignas(64) std::array<Row<float>, 3> origin, reciprocal;
    std::array<std::uint32_t, 3> near_row, far_row;
    bool is_one_octant;
  };

  bool is_inside;  ///< in the mesh of `instance`; otherwise the fields below are not set
  InstanceRecord instance;
  Address instance_address;
  double mesh_pad;         ///< tolerance in front of a box and behind it, in units of the mesh's records
  BoxRows in_mesh;         ///< rows of the rays that are inside
  BundleChildren outside;  ///< children that wait outside meanwhile

  /// Takes `next_rays` into a mesh: `next` becomes its first BVH node.
  void enter(const InstanceRecord& record, Address address, const GridFrame& frame);
  /// Restores the children that wait outside.
  void leave_mesh();
  /// Swaps the mesh's rows with the grid's.
  void swap_rows();
  /// Adds the instances of a leaf whose boxes some of `next_rays` meet to the waiting children.
  void meet_instances(const std::byte* leaf, bool in_order);
};
static_assert(std::is_trivially_copyable_v<InstanceBundle>);

/// The BVH node with boxes enlarged on all sides by at least `pad`.
BvhNode padded(const BvhNode& bvh_node, double pad);

}  // namespace dmpc::core
