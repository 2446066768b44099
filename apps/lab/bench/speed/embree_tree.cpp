#include "apps/lab/bench/speed/embree_tree.h"

#include <optional>

#include "apps/oracle/curved.h"

namespace dmpc::apps {

namespace {

/// Returns the least distance of hits along a ray. Rays start so near to the curved surface that they leave that Embree's floats
/// cannot distinguish the sides.
float start_of(const core::Ray& ray) {
  constexpr float share = 0x1p-16F;
  return share * core::largest_component(ray.origin) / core::largest_component(ray.direction);
}

/// Returns a distance within the ray, whose components Embree stores separately.
std::optional<float> distance(const embree::CurvedQuery& query) {
  RTCRayN* const ray = query.ray;
  const unsigned count = query.ray_count, i = query.index;
  core::Ray asked;
  asked.origin = {RTCRayN_org_x(ray, count, i), RTCRayN_org_y(ray, count, i), RTCRayN_org_z(ray, count, i)};
  asked.direction = {RTCRayN_dir_x(ray, count, i), RTCRayN_dir_y(ray, count, i), RTCRayN_dir_z(ray, count, i)};
  const float start = start_of(asked);
  asked.origin = asked.origin + asked.direction * start;
  asked.t_max = RTCRayN_tfar(ray, count, i) - start;
  const std::optional<double> t = nearest_on_curved(query.shapes.primitives[query.id], asked);
  return t ? std::optional(static_cast<float>(*t) + start) : std::nullopt;
}

}  // namespace

EmbreeTree::EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode)
    : shapes_(primitives),
      tree_(mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH) {
  if (!shapes_.triangles.empty()) {
    tree_.attach(embree::triangle_mesh(tree_.device(), shapes_));
  }
  if (!shapes_.curved.empty()) {
    tree_.attach(embree::curved_geometry<distance>(tree_.device(), shapes_));
  }
  DoubleStopwatch stopwatch;
  tree_.build();
  build_times_ = stopwatch.lap();
}

std::uint64_t EmbreeTree::trace(std::span<const core::Ray> rays, Query query) const {
  embree::Context context;
  embree::start(context);
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    if (query == Query::any) {
      RTCRay asked = embree::ray_of(ray);
      embree::occlude(library_, tree_.scene(), context, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(library_, tree_.scene(), context, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

}  // namespace dmpc::apps
