#include "core/trace/instance_bundle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/box.h"
#include "core/base/vector_width.h"
#include "core/trace/mesh_ray.h"

namespace dmpc::core {
namespace {

/// Copies the first `count` children.
void copy(const BundleChildren& from, BundleChildren& to) {
  to.count = from.count;
  std::copy_n(from.t_enter.begin(), from.count, to.t_enter.begin());
  std::copy_n(from.nearest.begin(), from.count, to.nearest.begin());
  std::copy_n(from.record.begin(), from.count, to.record.begin());
  std::copy_n(from.rays.begin(), from.count, to.rays.begin());
}

/// Moves the last waiting child before those that are no nearer, from position `first` on.
void put_in_order(BundleChildren& waiting, std::uint32_t first) {
  for (std::uint32_t place = waiting.count - 1; place > first && waiting.nearest[place - 1] < waiting.nearest[place]; --place) {
    std::swap(waiting.t_enter[place], waiting.t_enter[place - 1]);
    std::swap(waiting.nearest[place], waiting.nearest[place - 1]);
    std::swap(waiting.record[place], waiting.record[place - 1]);
    std::swap(waiting.rays[place], waiting.rays[place - 1]);
  }
}

}  // namespace

void InstanceBundle::enter(const InstanceRecord& record, Address address, const GridFrame& frame) {
  instance = record;
  instance_address = address;
  is_inside = true;
  mesh_pad = 0;
  in_mesh.is_one_octant = true;
  const auto first = static_cast<std::size_t>(std::countr_zero(next_rays));
  const MeshGate gate(record, frame);
  for (RayMask left = next_rays; left != 0; left &= left - 1) {
    const auto ray = static_cast<std::size_t>(std::countr_zero(left));
    const MeshWay way = gate.way_of(rays[ray]);
    mesh_pad = std::max(mesh_pad, way.pad);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      in_mesh.origin[axis][ray] = static_cast<float>(way.origin[axis]);
      in_mesh.reciprocal[axis][ray] = static_cast<float>(way.slope[axis]);
      const bool is_down = way.slope[axis] < 0;
      if (ray == first) {
        in_mesh.near_row[axis] = is_down ? axis + 3 : axis;
        in_mesh.far_row[axis] = is_down ? axis : axis + 3;
      }
      in_mesh.is_one_octant = in_mesh.is_one_octant && is_down == (in_mesh.near_row[axis] == axis + 3);
    }
  }
  copy(waiting, outside);
  waiting.count = 0;
  next = BvhChild::bvh_node(record.root);
}

void InstanceBundle::leave_mesh() {
  is_inside = false;
  copy(outside, waiting);
}

void InstanceBundle::swap_rows() {
  std::swap(origin, in_mesh.origin);
  std::swap(reciprocal, in_mesh.reciprocal);
  std::swap(near_row, in_mesh.near_row);
  std::swap(far_row, in_mesh.far_row);
  std::swap(is_one_octant, in_mesh.is_one_octant);
}

void InstanceBundle::meet_instances(const std::byte* leaf, bool in_order) {
  const auto header = read<LeafHeader>(leaf);
  const std::size_t lanes = header.count;
  const auto* const rows = reinterpret_cast<const float*>(leaf + sizeof(header));
  static const VectorWidth width = vector_width();
  const std::uint32_t first = waiting.count;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    Row<float>& enter = waiting.t_enter[waiting.count];
    alignas(64) Row<float> leave;
    run_by(width, [&] {
      for (std::size_t ray = 0; ray < bundle_rays_max; ++ray) {
        enter[ray] = t_low[ray];
        leave[ray] = std::min(t_high[ray], best.t[ray]);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float low = rows[axis * lanes + lane], high = rows[(axis + 3) * lanes + lane];
        for (std::size_t ray = 0; ray < bundle_rays_max; ++ray) {
          const float one = (low - origin[axis][ray]) * reciprocal[axis][ray],
                      other = (high - origin[axis][ray]) * reciprocal[axis][ray];
          enter[ray] = std::max(enter[ray], std::min(one, other));
          leave[ray] = std::min(leave[ray], std::max(one, other));
        }
      }
    });
    RayMask met = 0;
    for (RayMask left = next_rays; left != 0; left &= left - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(left));
      met |= enter[ray] <= leave[ray] ? RayMask{1} << ray : 0;
    }
    if (met != 0) {
      waiting.record[waiting.count] = BvhChild::leaf(instance_in(leaf, lane));
      waiting.rays[waiting.count] = met;
      waiting.nearest[waiting.count] = enter[static_cast<std::size_t>(std::countr_zero(met))];
      ++waiting.count;
      if (in_order) {
        put_in_order(waiting, first);
      }
    }
  }
}

BvhNode padded(const BvhNode& bvh_node, double pad) {
  if (bvh_node.child_count == 0) {
    return bvh_node;  // a node without the record has one of zeros, whose unit is 0
  }
  const auto steps = static_cast<std::uint64_t>(std::ceil(pad / double{bvh_node.unit}));
  const int doublings = std::max(0, static_cast<int>(std::bit_width(2 * steps + 255)) - 8);
  const std::uint64_t rounding = (std::uint64_t{1} << doublings) - 1;
  // Halves once more if rounding up needs another bit.
  const int shift = ((2 * steps + 255 + rounding) >> doublings) > 255 ? doublings + 1 : doublings;
  const std::uint64_t up = (std::uint64_t{1} << shift) - 1;
  BvhNode larger = bvh_node;
  larger.unit = std::ldexp(bvh_node.unit, shift);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    larger.origin[axis] = rounded_down(double{bvh_node.origin[axis]} - static_cast<double>(steps) * double{bvh_node.unit});
    for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
      larger.bounds[axis][child] = static_cast<std::uint8_t>(std::uint64_t{bvh_node.bounds[axis][child]} >> shift);
      larger.bounds[axis + 3][child] = static_cast<std::uint8_t>((bvh_node.bounds[axis + 3][child] + 2 * steps + up) >> shift);
    }
  }
  return larger;
}

}  // namespace dmpc::core
