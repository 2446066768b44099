// A ray on its way through a base mesh: its boxes alone, since triangles come out to the ray.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/cursor.h"

namespace dmpc::core {

/// What a ray is to a base mesh, in the mesh's records' units. Its direction is not made unit length, so t is the grid's.
struct MeshWay {
  Vec3d origin;
  Vec3d slope;     ///< one over each component of the direction, never infinite
  double pad = 0;  ///< how far in front of a box, and behind it, the ray may be for it to count: for all that rounds
};

/// The way into a base mesh.
class MeshGate {
 public:
  MeshGate(const InstanceRecord& instance, const GridFrame& frame);
  MeshWay way_of(const Ray& ray) const;

 private:
  Vec3d inside(const Vec3d& v) const { return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z; }

  std::array<Vec3d, 3> columns_;  ///< of the inverse of what places the mesh in the grid
  Vec3d shift_;
  double pad_;
};

/// A ray as the boxes of a mesh need it: each begins by the pad earlier, and ends by it later.
struct MeshRay {
  MeshRay() = default;
  MeshRay(const Ray& ray, const InstanceRecord& instance, const GridFrame& frame);

  /// As a BvhNodeKernel: which of a BVH node's children it meets in [t_low, t_high].
  BvhChild meet(const BvhNode& bvh_node, float t_low, float t_high, bool in_order, MetChildren& waiting) const;

  Vec3f near_origin, far_origin, reciprocal;
  std::array<std::uint32_t, 3> near_row{}, far_row{};
};

}  // namespace dmpc::core
