// The only file that includes Embree: one ray asked of its version 3 or 4.
#pragma once

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

}  // namespace dmpc::apps::embree
