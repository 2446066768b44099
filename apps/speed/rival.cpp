#include "apps/speed/rival.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/curved.h"
#include "apps/embree.h"
#include "core/expect.h"

namespace dmpc::apps {

struct EmbreeRival::Parts {
  explicit Parts(std::uint32_t thread_count)
      : device(rtcNewDevice(thread_count == 0 ? nullptr : ("threads=" + std::to_string(thread_count)).c_str())) {
    core::expect(device != nullptr, "Embree opens its device");
    scene = rtcNewScene(device);
  }
  ~Parts() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void sort(std::span<const core::PrimitiveValues> given);
  void build(EmbreeMode mode, EmbreeQuality quality);
  void attach(RTCGeometry geometry, RTCBuildQuality quality) const;
  RTCGeometry curved_geometry();

  /// The t of a curved primitive, by Embree's index, within the ray, whose components Embree keeps one by one.
  std::optional<float> distance(unsigned index, RTCRayN* ray, unsigned count) const;
  static const Parts& of(const void* user_data) { return *static_cast<const Parts*>(user_data); }
  static void bounds_callback(const RTCBoundsFunctionArguments* arguments);
  static void intersect_callback(const RTCIntersectFunctionNArguments* arguments);
  static void occluded_callback(const RTCOccludedFunctionNArguments* arguments);

  RTCDevice device;
  RTCScene scene = nullptr;
  std::span<const core::PrimitiveValues> primitives;
  std::vector<std::uint32_t> triangles, curved;  ///< Embree's index -> primitive id
  Times build_times;
};

void EmbreeRival::Parts::sort(std::span<const core::PrimitiveValues> given) {
  primitives = given;
  for (std::uint32_t id = 0; id < given.size(); ++id) {
    (given[id].kind == core::PrimitiveKind::triangle ? triangles : curved).push_back(id);
  }
}

std::optional<float> EmbreeRival::Parts::distance(unsigned index, RTCRayN* ray, unsigned count) const {
  core::Ray asked;
  asked.origin = {RTCRayN_org_x(ray, count, 0), RTCRayN_org_y(ray, count, 0), RTCRayN_org_z(ray, count, 0)};
  asked.direction = {RTCRayN_dir_x(ray, count, 0), RTCRayN_dir_y(ray, count, 0), RTCRayN_dir_z(ray, count, 0)};
  asked.t_max = RTCRayN_tfar(ray, count, 0);
  const std::optional<double> t = nearest_on_curved(primitives[curved[index]], asked);
  return t ? std::optional(static_cast<float>(*t)) : std::nullopt;
}

void EmbreeRival::Parts::bounds_callback(const RTCBoundsFunctionArguments* arguments) {
  const Parts& parts = of(arguments->geometryUserPtr);
  embree::set_bounds(*arguments->bounds_o, bounds_of_curved(parts.primitives[parts.curved[arguments->primID]]));
}

void EmbreeRival::Parts::intersect_callback(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayN* const ray = RTCRayHitN_RayN(arguments->rayhit, arguments->N);
  const Parts& parts = of(arguments->geometryUserPtr);
  const auto t = arguments->valid[0] != 0 ? parts.distance(arguments->primID, ray, arguments->N) : std::nullopt;
  if (t) {
    RTCRayN_tfar(ray, arguments->N, 0) = *t;
    RTCHitN* const hit = RTCRayHitN_HitN(arguments->rayhit, arguments->N);
    RTCHitN_primID(hit, arguments->N, 0) = arguments->primID;
    RTCHitN_geomID(hit, arguments->N, 0) = arguments->geomID;
  }
}

void EmbreeRival::Parts::occluded_callback(const RTCOccludedFunctionNArguments* arguments) {
  const Parts& parts = of(arguments->geometryUserPtr);
  if (arguments->valid[0] != 0 && parts.distance(arguments->primID, arguments->ray, arguments->N)) {
    RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
  }
}

RTCGeometry EmbreeRival::Parts::curved_geometry() {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(curved.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_callback);
  rtcSetGeometryOccludedFunction(geometry, occluded_callback);
  return geometry;
}

void EmbreeRival::Parts::attach(RTCGeometry geometry, RTCBuildQuality quality) const {
  rtcSetGeometryBuildQuality(geometry, quality);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void EmbreeRival::Parts::build(EmbreeMode mode, EmbreeQuality quality) {
  const RTCBuildQuality effort = quality == EmbreeQuality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  rtcSetSceneFlags(scene, mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene, effort);
  if (!triangles.empty()) {
    attach(embree::triangle_mesh(device, primitives, triangles), effort);
  }
  if (!curved.empty()) {
    attach(curved_geometry(), effort);
  }
  DoubleStopwatch stopwatch;
  rtcCommitScene(scene);
  build_times = stopwatch.lap();
  core::expect(rtcGetDeviceError(device) == RTC_ERROR_NONE, "Embree builds the scene without an error");
}

EmbreeRival::EmbreeRival(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
                         std::uint32_t thread_count)
    : parts_(std::make_unique<Parts>(thread_count)) {
  parts_->sort(primitives);
  parts_->build(mode, quality);
}

EmbreeRival::~EmbreeRival() = default;

std::uint64_t EmbreeRival::trace(std::span<const core::Ray> rays, Query query) const {
  embree::Context context;
  embree::start(context);
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    if (query == Query::any) {
      RTCRay asked = embree::ray_of(ray);
      embree::occlude(parts_->scene, context, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(parts_->scene, context, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

Times EmbreeRival::build_times() const { return parts_->build_times; }

}  // namespace dmpc::apps
