// The only file that includes Embree: its geometries, and one ray asked of its version 3 or 4.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/database.h"
#include "core/ray.h"

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace dmpc::apps::embree {

// Embree 4 renamed the context and moved it into an arguments structure. That branch is untested: Debian 12 has 3.13.
#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
inline void start(Context& context) { rtcInitRayQueryContext(&context); }
inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray_hit, &arguments);
}
inline void occlude(RTCScene scene, Context& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
/// What a query's callbacks are handed: make it the first member of a structure to let them find more.
using Context = RTCIntersectContext;
inline void start(Context& context) { rtcInitIntersectContext(&context); }
/// The closest hit.
inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray_hit) { rtcIntersect1(scene, &context, &ray_hit); }
/// Any hit.
inline void occlude(RTCScene scene, Context& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

/// The ray as Embree takes it: from 0 to its t_max, seen by all geometries.
inline RTCRay ray_of(const core::Ray& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x, result.org_y = ray.origin.y, result.org_z = ray.origin.z;
  result.dir_x = ray.direction.x, result.dir_y = ray.direction.y, result.dir_z = ray.direction.z;
  result.tfar = ray.t_max;
  result.mask = ~0U;
  return result;
}

/// A mesh, not yet committed, of the triangles `ids` of `primitives`, in their order and without shared vertices; the caller
/// releases it.
RTCGeometry triangle_mesh(RTCDevice device, std::span<const core::PrimitiveValues> primitives,
                          std::span<const std::uint32_t> ids);

/// `box`: lower x y z, upper x y z.
inline void set_bounds(RTCBounds& bounds, const std::array<float, 6>& box) {
  bounds.lower_x = box[0], bounds.lower_y = box[1], bounds.lower_z = box[2];
  bounds.upper_x = box[3], bounds.upper_y = box[4], bounds.upper_z = box[5];
}

}  // namespace dmpc::apps::embree
