// A ray in a base mesh, for its boxes alone: triangles are tested in the grid's coordinates.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"
#include "core/record/instance.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/trace/cursor.h"

namespace dmpc::core {

/// A ray in a base mesh, in units of the mesh's records. Its direction is not normalised, so t is the grid's.
struct MeshWay {
  Vec3d origin;
  Vec3d slope;     ///< the reciprocal of each component of the direction, never infinite
  double pad = 0;  ///< tolerance in front of a box and behind it, for all rounding
};

/// Transforms rays into a base mesh.
class MeshGate {
 public:
  MeshGate(const InstanceRecord& instance, const GridFrame& frame);
  MeshWay way_of(const Ray& ray) const;

 private:
  Vec3d inside(const Vec3d& v) const { return columns_[0] * v.x + columns_[1] * v.y + columns_[2] * v.z; }

  std::array<Vec3d, 3> columns_;  ///< columns of the inverse of the mesh's transform into the grid
  Vec3d shift_;
  double pad_;
};

/// A ray as boxes of a mesh need it: each begins earlier by the pad, and ends later by it.
struct MeshRay {
  MeshRay() = default;
  MeshRay(const Ray& ray, const InstanceRecord& instance, const GridFrame& frame);

  /// As a BvhNodeKernel: the BVH node's children that the ray meets in [t_low, t_high].
  BvhChild meet(const BvhNode& bvh_node, float t_low, float t_high, bool in_order, MetChildren& waiting) const;

  Vec3f near_origin, far_origin, reciprocal;
  std::array<std::uint32_t, 3> near_row{}, far_row{};
};

}  // namespace dmpc::core
