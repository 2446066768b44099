#include "core/trace/mesh_ray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/vector_width.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// The rounding error of floats for a box's plane and for the ray's distance to it, as a share of that distance and of the mesh's
/// size: eight roundings of 2^-24 each.
constexpr double rounding_pad = 0x1p-20;

}  // namespace

MeshGate::MeshGate(const InstanceRecord& instance, const GridFrame& frame) : pad_(double{instance.pad}) {
  const MeshToGrid way(instance, frame);
  columns_ = inverse_of(way.rows);
  shift_ = way.shift;
}

MeshWay MeshGate::way_of(const Ray& ray) const {
  MeshWay way{.origin = inside(Vec3d(ray.origin) - shift_), .slope = {}};
  const Vec3d direction = inside(Vec3d(ray.direction));
  const double least = double{smallest_component} * largest_component(direction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    way.slope[axis] = 1.0 / (std::fabs(d) >= least ? d : std::copysign(least, d));
  }
  way.pad = pad_ + rounding_pad * (largest_component(way.origin) + 1);
  return way;
}

MeshRay::MeshRay(const Ray& ray, const InstanceRecord& instance, const GridFrame& frame) {
  const MeshWay way = MeshGate(instance, frame).way_of(ray);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const double slope = way.slope[axis], pad = std::copysign(way.pad, slope);
    reciprocal[axis] = static_cast<float>(slope);
    near_origin[axis] = static_cast<float>(way.origin[axis] + pad);
    far_origin[axis] = static_cast<float>(way.origin[axis] - pad);
    near_row[axis] = slope < 0 ? axis + 3 : axis;
    far_row[axis] = slope < 0 ? axis : axis + 3;
  }
}

BvhChild MeshRay::meet(const BvhNode& bvh_node, float t_low, float t_high, bool in_order, MetChildren& waiting) const {
  std::array<float, bvh_children_max> enter, leave;
  enter.fill(t_low);
  leave.fill(t_high);
  static const VectorWidth width = vector_width();
  run_by(width, [&] {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float slope = bvh_node.unit * reciprocal[axis];
      const float near_offset = (bvh_node.origin[axis] - near_origin[axis]) * reciprocal[axis],
                  far_offset = (bvh_node.origin[axis] - far_origin[axis]) * reciprocal[axis];
      const auto &near_bounds = bvh_node.bounds[near_row[axis]], &far_bounds = bvh_node.bounds[far_row[axis]];
      for (std::size_t child = 0; child < bvh_children_max; ++child) {
        const float from = static_cast<float>(near_bounds[child]) * slope + near_offset,
                    to = static_cast<float>(far_bounds[child]) * slope + far_offset;
        enter[child] = from > enter[child] ? from : enter[child];  // comparisons with NaN change nothing
        leave[child] = to < leave[child] ? to : leave[child];
      }
    }
  });
  const std::uint32_t first = waiting.count;
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    if (enter[child] <= leave[child]) {
      waiting.add(bvh_node.child[child], enter[child], in_order ? first : waiting.count);
    }
  }
  return waiting.count > first ? waiting.take() : BvhChild::none();
}

}  // namespace dmpc::core
