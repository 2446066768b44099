#include "core/picture/hits/hit_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/expect.h"
#include "core/picture/hits/triangle_hit.h"
#include "core/record/curved_values.h"
#include "core/trace/primitive.h"

namespace dmpc::core {
namespace {

Vec3d along(const Ray& ray, double t) { return ray.full_origin() + ray.full_direction() * t; }

/// Where faces share a plane, the point lies in that plane and has its normal: the faces are one surface, and a ray starts off it
/// on one of its sides.
void triangle_geometry(HitState& state, const LeafLane& lane, const FacePlane* shared) {
  const Vec3d corner = lane.vector(0), edge1 = lane.vector(3) - corner, edge2 = lane.vector(6) - corner;
  const Vec3d origin = state.ray.full_origin(), direction = state.ray.full_direction();
  const double t{state.hit.t};
  find_weights(edge1, edge2, origin - corner, direction, place_of(origin, direction, t), [&](double u, double v) {
    state.u = u;
    state.v = v;
  });
  state.point = point_at(corner, edge1, edge2, state.u, state.v);
  state.geometric_normal = unit_normal_of(edge1, edge2);
  if (shared != nullptr) {
    state.point = state.point - shared->normal * shared->height_of(state.point);
    state.geometric_normal = dot(shared->normal, state.geometric_normal) < 0.0 ? -shared->normal : shared->normal;
  }
  state.clearance = Clearance::of_flat(clearance_of(corner, edge1, edge2, state.geometric_normal, state.u, state.v, t));
}

/// In an exact plane, which has others next to it: the corners are first moved into the plane, so that grazing rays hit it at the
/// right point; rays start off it by the rounding error of doubles.
void exact_geometry(HitState& state, const LeafLane& lane, const FacePlane& plane) {
  const auto in_plane = [&](const Vec3d& point) { return point - plane.normal * plane.height_of(point); };
  const Vec3d corner = in_plane(lane.vector(0)), edge1 = in_plane(lane.vector(3)) - corner,
              edge2 = in_plane(lane.vector(6)) - corner;
  const Vec3d origin = state.ray.full_origin(), direction = state.ray.full_direction();
  find_weights(edge1, edge2, origin - corner, direction, place_of(origin, direction, double{state.hit.t}),
               [&](double u, double v) {
                 state.u = u;
                 state.v = v;
               });
  state.point = in_plane(point_at(corner, edge1, edge2, state.u, state.v));
  state.geometric_normal = dot(plane.normal, cross(edge1, edge2)) < 0.0 ? -plane.normal : plane.normal;
  state.clearance = Clearance::of_flat(exact_clearance_of(edge1, edge2, plane.normal, state.point, state.u, state.v));
}

void sphere_geometry(HitState& state, const LeafLane& lane) {
  const CurvedValues sphere(PrimitiveKind::sphere, lane.rows, lane.stride, lane.lane);
  const Vec3d center = sphere.vector(0);
  const double radius = std::fabs(sphere.value(3));
  const double t = sphere_distance(state.ray, lane.rows, lane.stride, lane.lane);
  state.geometric_normal = normalize(along(state.ray, t) - center);
  state.point = center + state.geometric_normal * radius;
  state.clearance = clearance_on_curved(state, largest_component(center) + radius, radius, sphere.passes_by());
}

/// The least cosine of a cone's axis with a surface that is distinguished from 0.
constexpr double cosine_min = 1e-6;
/// Weights change by less than this along an ellipse; larger changes are clamped.
constexpr double change_max = 1e30;

float bounded(double change) { return static_cast<float>(std::clamp(change, -change_max, change_max)); }

/// On a flat cone the distance from the axis determines the point better than the height does.
void cone_geometry(HitState& state, const LeafLane& lane) {
  const CurvedValues cone(PrimitiveKind::cone, lane.rows, lane.stride, lane.lane);
  const Vec3d base = cone.vector(0), apex = cone.apex(), axis = cone.axis();
  const double t = cone_distance(state.ray, lane.rows, lane.stride, lane.lane);
  const Vec3d from_base = along(state.ray, t) - base;
  const double base_radius = std::fabs(cone.value(3)), widening = std::fabs(cone.value(7)) - base_radius;
  const double up = std::clamp(dot(from_base, axis) / dot(axis, axis), 0.0, 1.0);
  const Vec3d outward = from_base - axis * up;
  const double distance = length(outward);
  const double height = cone.is_flat() && widening != 0.0 ? std::clamp((distance - base_radius) / widening, 0.0, 1.0) : up;
  const double radius = base_radius + widening * height;
  const Vec3d radial = distance > 0.0 ? outward * (1.0 / distance) : Vec3d{};
  state.point = base + axis * height + radial * radius;
  const Vec3d normal = radial * dot(axis, axis) - axis * widening;
  state.geometric_normal = normalize(normal);
  const double size = std::max(largest_component(base), largest_component(apex)) + base_radius + std::max(widening, 0.0);
  state.clearance = clearance_on_curved(state, size, radius, cone.passes_by());
}

}  // namespace

LeafLane lane_of(const HitState& state, const std::byte* record) {
  const auto header = read<LeafHeader>(record);
  return {reinterpret_cast<const float*>(record + sizeof(LeafHeader)), header.count, state.hit.lane & lane_mask};
}

void read_surface(HitState& state, const std::byte* record) {
  const auto header = read<LeafHeader>(record);
  const std::size_t references = (value_count(header.kind) + 1) * header.count;
  state.shading = read<ShadingReference>(record + sizeof(LeafHeader) + 4 * (references + (state.hit.lane & lane_mask)));
  state.curved = header.kind != PrimitiveKind::triangle;
  state.leaving = dot(state.ray.full_direction(), state.geometric_normal) > 0.0;
  state.normal = state.leaving ? -state.geometric_normal : state.geometric_normal;
  state.stage = state.shading.is_smooth() ? HitState::Stage::normals : HitState::Stage::material;
}

void read_geometry(HitState& state, const std::byte* record) {
  const auto header = read<LeafHeader>(record);
  const LeafLane lane = lane_of(state, record);
  switch (header.kind) {
    case PrimitiveKind::triangle:
      if (header.has_plane()) {
        const FacePlane plane = plane_of(header, record);
        header.has_exact_plane() ? exact_geometry(state, lane, plane) : triangle_geometry(state, lane, &plane);
      } else {
        triangle_geometry(state, lane, nullptr);
      }
      break;
    case PrimitiveKind::sphere:
      sphere_geometry(state, lane);
      break;
    case PrimitiveKind::cone:
      cone_geometry(state, lane);
      break;
    case PrimitiveKind::instance:
      expect(false, "no ray hits the box of an instance");
  }
  read_surface(state, record);
}

CutEllipse cut_ellipse(const HitState& state, const std::byte* record, const Vec3d& upright) {
  const LeafLane lane = lane_of(state, record);
  const Vec3d v0 = lane.vector(0), edge1 = lane.vector(3) - v0, edge2 = lane.vector(6) - v0, normal = cross(edge1, edge2);
  const double square = dot(normal, normal);
  if (!(square > 0.0)) {
    return {};
  }
  const Vec3d direction(state.ray.direction), unit = state.geometric_normal;
  const double approach = std::copysign(std::max(std::fabs(dot(direction, unit)), cosine_min), dot(direction, unit));
  // One diameter of the disc lies in the triangle's plane; the other is projected there along the ray.
  const Vec3d common = cross(unit, upright);
  const Vec3d across = normalize(dot(common, common) > 0.0 ? common : edge1), outwards = cross(upright, across);
  const std::array<Vec3d, 2> axes{outwards - direction * (dot(outwards, unit) / approach), across};
  const Vec3d of_u = cross(edge2, normal), of_v = cross(normal, edge1);
  CutEllipse ellipse;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    ellipse.axis[axis] = {bounded(dot(axes[axis], of_u) / square), bounded(dot(axes[axis], of_v) / square)};
  }
  return ellipse;
}

}  // namespace dmpc::core
