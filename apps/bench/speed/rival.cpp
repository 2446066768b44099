#include "apps/bench/speed/rival.h"

#include <optional>
#include <string>

#include "apps/oracle/curved.h"
#include "apps/oracle/embree.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Within the ray, whose components Embree keeps one by one.
std::optional<float> distance(const embree::CurvedQuery& query) {
  RTCRayN* const ray = query.ray;
  const unsigned count = query.ray_count;
  core::Ray asked;
  asked.origin = {RTCRayN_org_x(ray, count, 0), RTCRayN_org_y(ray, count, 0), RTCRayN_org_z(ray, count, 0)};
  asked.direction = {RTCRayN_dir_x(ray, count, 0), RTCRayN_dir_y(ray, count, 0), RTCRayN_dir_z(ray, count, 0)};
  asked.t_max = RTCRayN_tfar(ray, count, 0);
  const std::optional<double> t = nearest_on_curved(query.shapes.primitives[query.id], asked);
  return t ? std::optional(static_cast<float>(*t)) : std::nullopt;
}

}  // namespace

struct EmbreeRival::Parts {
  Parts(std::span<const core::PrimitiveValues> primitives, std::uint32_t thread_count)
      : device(library.new_device(thread_count == 0 ? nullptr : ("threads=" + std::to_string(thread_count)).c_str())),
        shapes(primitives) {
    core::expect(device != nullptr, "Embree opens its device");
    scene = library.new_scene(device);
  }
  ~Parts() {
    library.release_scene(scene);
    library.release_device(device);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void build(EmbreeMode mode, EmbreeQuality quality);

  const embree::Library& library = embree::library();
  RTCDevice device;
  RTCScene scene = nullptr;
  embree::Shapes shapes;
  Times build_times;
};

void EmbreeRival::Parts::build(EmbreeMode mode, EmbreeQuality quality) {
  const RTCBuildQuality effort = quality == EmbreeQuality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  library.set_scene_flags(scene, mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  library.set_scene_build_quality(scene, effort);
  if (!shapes.triangles.empty()) {
    embree::attach(scene, embree::triangle_mesh(device, shapes), effort);
  }
  if (!shapes.curved.empty()) {
    embree::attach(scene, embree::curved_geometry<distance>(device, shapes), effort);
  }
  DoubleStopwatch stopwatch;
  library.commit_scene(scene);
  build_times = stopwatch.lap();
  core::expect(library.device_error(device) == RTC_ERROR_NONE, "Embree builds the scene without an error");
}

EmbreeRival::EmbreeRival(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
                         std::uint32_t thread_count)
    : parts_(std::make_unique<Parts>(primitives, thread_count)) {
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
      embree::occlude(parts_->library, parts_->scene, context, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(parts_->library, parts_->scene, context, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

Times EmbreeRival::build_times() const { return parts_->build_times; }

}  // namespace dmpc::apps
