// The module dmpc_embree.so: what dmpc calls of Embree.

#include "apps/oracle/embree.h"
#include "apps/frontend/system/module.h"

namespace dmpc::apps::embree {
namespace {

constexpr Library functions{
    .new_device = rtcNewDevice,
    .release_device = rtcReleaseDevice,
    .device_error = rtcGetDeviceError,
    .new_scene = rtcNewScene,
    .release_scene = rtcReleaseScene,
    .set_scene_flags = rtcSetSceneFlags,
    .set_scene_build_quality = rtcSetSceneBuildQuality,
    .commit_scene = rtcCommitScene,
    .attach_geometry = rtcAttachGeometry,
    .new_geometry = rtcNewGeometry,
    .release_geometry = rtcReleaseGeometry,
    .commit_geometry = rtcCommitGeometry,
    .set_geometry_build_quality = rtcSetGeometryBuildQuality,
    .set_new_geometry_buffer = rtcSetNewGeometryBuffer,
    .set_geometry_user_data = rtcSetGeometryUserData,
    .set_geometry_user_primitive_count = rtcSetGeometryUserPrimitiveCount,
    .set_geometry_bounds_function = rtcSetGeometryBoundsFunction,
    .set_geometry_intersect_function = rtcSetGeometryIntersectFunction,
    .set_geometry_occluded_function = rtcSetGeometryOccludedFunction,
    .set_geometry_intersect_filter_function = rtcSetGeometryIntersectFilterFunction,
    .set_geometry_occluded_filter_function = rtcSetGeometryOccludedFilterFunction,
    .intersect = rtcIntersect1,
    .occluded = rtcOccluded1,
};

}  // namespace
}  // namespace dmpc::apps::embree

extern "C" __attribute__((visibility("default")))
const dmpc::apps::Module dmpc_module{DMPC_MODULES_BUILD, &dmpc::apps::embree::functions};
