// The only file that includes Embree, version 3 or 4: what dmpc calls of it, its geometries, and rays asked of it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/database/database.h"
#include "core/record/ray.h"

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace dmpc::apps::embree {

/// Embree's functions, which the module dmpc_embree.so is linked with, and nothing else.
struct Library {
  decltype(&rtcNewDevice) new_device;
  decltype(&rtcReleaseDevice) release_device;
  decltype(&rtcGetDeviceError) device_error;
  decltype(&rtcNewScene) new_scene;
  decltype(&rtcReleaseScene) release_scene;
  decltype(&rtcSetSceneFlags) set_scene_flags;
  decltype(&rtcSetSceneBuildQuality) set_scene_build_quality;
  decltype(&rtcCommitScene) commit_scene;
  decltype(&rtcAttachGeometry) attach_geometry;
  decltype(&rtcNewGeometry) new_geometry;
  decltype(&rtcReleaseGeometry) release_geometry;
  decltype(&rtcCommitGeometry) commit_geometry;
  decltype(&rtcSetGeometryBuildQuality) set_geometry_build_quality;
  decltype(&rtcSetNewGeometryBuffer) set_new_geometry_buffer;
  decltype(&rtcSetGeometryUserData) set_geometry_user_data;
  decltype(&rtcSetGeometryUserPrimitiveCount) set_geometry_user_primitive_count;
  decltype(&rtcSetGeometryBoundsFunction) set_geometry_bounds_function;
  decltype(&rtcSetGeometryIntersectFunction) set_geometry_intersect_function;
  decltype(&rtcSetGeometryOccludedFunction) set_geometry_occluded_function;
  decltype(&rtcSetGeometryIntersectFilterFunction) set_geometry_intersect_filter_function;
  decltype(&rtcSetGeometryOccludedFilterFunction) set_geometry_occluded_filter_function;
  decltype(&rtcIntersect1) intersect;
  decltype(&rtcOccluded1) occluded;
};

/// Opened at the first call, as open_module() says. Thread-safe.
const Library& library();

/// A scene on a device of its own, and the owner of both.
class OwnedScene {
 public:
  /// An empty scene, which Embree builds on all processors. Throws core::InternalError if Embree opens no device.
  OwnedScene(RTCSceneFlags flags, RTCBuildQuality quality);
  ~OwnedScene();
  OwnedScene(const OwnedScene&) = delete;
  OwnedScene& operator=(const OwnedScene&) = delete;

  /// For geometries that are to be attached.
  RTCDevice device() const { return device_; }
  /// To be asked, once it is built.
  RTCScene scene() const { return scene_; }
  /// Commits a geometry, with the scene's quality, and takes it over.
  void attach(RTCGeometry geometry);
  /// Throws core::InternalError if Embree reports an error.
  void build();

 private:
  const Library& library_ = library();
  RTCBuildQuality quality_;
  RTCDevice device_;
  RTCScene scene_;
};

// Embree 4 renamed the context and moved it into an arguments structure. That branch is untested: Debian 12 has 3.13.
#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
inline void start(Context& context) { rtcInitRayQueryContext(&context); }
inline void intersect(const Library& library, RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  library.intersect(scene, &ray_hit, &arguments);
}
inline void occlude(const Library& library, RTCScene scene, Context& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  library.occluded(scene, &ray, &arguments);
}
#else
/// What a query's callbacks are handed: make it the first member of a structure to let them find more.
using Context = RTCIntersectContext;
inline void start(Context& context) { rtcInitIntersectContext(&context); }
/// The closest hit.
inline void intersect(const Library& library, RTCScene scene, Context& context, RTCRayHit& ray_hit) {
  library.intersect(scene, &context, &ray_hit);
}
/// Any hit.
inline void occlude(const Library& library, RTCScene scene, Context& context, RTCRay& ray) {
  library.occluded(scene, &context, &ray);
}
#endif

/// A ray as Embree takes it: from 0 to t_max, seen by all geometries.
inline RTCRay ray_of(const core::Vec3f& origin, const core::Vec3f& direction, float t_max) {
  RTCRay result{};
  result.org_x = origin.x, result.org_y = origin.y, result.org_z = origin.z;
  result.dir_x = direction.x, result.dir_y = direction.y, result.dir_z = direction.z;
  result.tfar = t_max;
  result.mask = ~0U;
  return result;
}
inline RTCRay ray_of(const core::Ray& ray) { return ray_of(ray.origin, ray.direction, ray.t_max); }

/// A scene's primitives as Embree gets them. They outlive it.
struct Shapes {
  std::span<const core::PrimitiveValues> primitives;
  std::vector<std::uint32_t> triangles, curved;  ///< Embree's index -> primitive id

  explicit Shapes(std::span<const core::PrimitiveValues> primitives);
};

/// A mesh, not yet committed, of the triangles, in their order and without shared vertices.
RTCGeometry triangle_mesh(RTCDevice device, const Shapes& shapes);

/// Who asks for a curved primitive, `id`: a ray, as Embree keeps it, in a query.
struct CurvedQuery {
  const Shapes& shapes;
  std::uint32_t id;
  RTCRayN* ray;
  unsigned ray_count;  ///< side by side in `ray`
  unsigned index;      ///< index of the primitive
  Context* context;
};
/// Where the ray meets the primitive; nothing if nowhere, or if the query does not want it.
using CurvedDistance = std::optional<float>(const CurvedQuery&);

/// User geometry, not yet committed, of the spheres and cones, which `distance` finds. The shapes outlive it.
RTCGeometry curved_geometry(RTCDevice device, const Shapes& shapes, RTCIntersectFunctionN intersect,
                            RTCOccludedFunctionN occlude);
template <CurvedDistance distance>
RTCGeometry curved_geometry(RTCDevice device, const Shapes& shapes);

/// What a callback is to ask about ray `index` of `ray`.
template <class Arguments>
CurvedQuery curved_query(const Arguments& arguments, RTCRayN* ray, unsigned index) {
  const Shapes& shapes = *static_cast<const Shapes*>(arguments.geometryUserPtr);
  return {shapes, shapes.curved[arguments.primID], ray, arguments.N, index, arguments.context};
}

template <CurvedDistance distance>
void intersect_curved(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayN* const ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  RTCHitN* const hit = RTCRayHitN_HitN(arguments->rayhit, arguments->N);
  for (unsigned i = 0; i < arguments->N; ++i) {
    const auto t = arguments->valid[i] != 0 ? distance(curved_query(*arguments, ray, i)) : std::nullopt;
    if (t) {
      RTCRayN_tfar(ray, arguments->N, i) = *t;
      RTCHitN_primID(hit, arguments->N, i) = arguments->primID;
      RTCHitN_geomID(hit, arguments->N, i) = arguments->geomID;
    }
  }
}

template <CurvedDistance distance>
void occlude_curved(const RTCOccludedFunctionNArguments* arguments) {
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] != 0 && distance(curved_query(*arguments, arguments->ray, i))) {
      RTCRayN_tfar(arguments->ray, arguments->N, i) = -std::numeric_limits<float>::infinity();
    }
  }
}

template <CurvedDistance distance>
RTCGeometry curved_geometry(RTCDevice device, const Shapes& shapes) {
  return curved_geometry(device, shapes, intersect_curved<distance>, occlude_curved<distance>);
}

}  // namespace dmpc::apps::embree
