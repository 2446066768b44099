#include "apps/bench/speed/embree_tree.h"

#include <optional>
#include <string>

#include "apps/oracle/curved.h"
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

EmbreeTree::EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
                       std::uint32_t thread_count)
    : device_(library_.new_device(thread_count == 0 ? nullptr : ("threads=" + std::to_string(thread_count)).c_str())),
      scene_(device_ == nullptr ? nullptr : library_.new_scene(device_)),
      shapes_(primitives) {
  core::expect(scene_ != nullptr, "Embree opens its device");
  const RTCBuildQuality effort = quality == EmbreeQuality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  library_.set_scene_flags(scene_, mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  library_.set_scene_build_quality(scene_, effort);
  if (!shapes_.triangles.empty()) {
    embree::attach(scene_, embree::triangle_mesh(device_, shapes_), effort);
  }
  if (!shapes_.curved.empty()) {
    embree::attach(scene_, embree::curved_geometry<distance>(device_, shapes_), effort);
  }
  DoubleStopwatch stopwatch;
  library_.commit_scene(scene_);
  build_times_ = stopwatch.lap();
  core::expect(library_.device_error(device_) == RTC_ERROR_NONE, "Embree builds the scene without an error");
}

EmbreeTree::~EmbreeTree() {
  library_.release_scene(scene_);
  library_.release_device(device_);
}

}  // namespace dmpc::apps
