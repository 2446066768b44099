#include "apps/lab/bench/speed/embree_tree.h"

#include <limits>

namespace dmpc::apps {

namespace {

/// Returns where a query's only ray meets the quadric, NaN if nowhere. Rays start so near to the curved surface that they leave
/// that only doubles distinguish the sides.
float distance(void* shapes, unsigned quadric, const core::Vec3d& origin, const core::Vec3d& direction, float t_far) {
  constexpr double share = 0x1p-16;
  const double start = share * largest_component(origin) / largest_component(direction);
  return static_cast<float>(static_cast<const PlainShapes*>(static_cast<embree::Shapes*>(shapes))
                                ->quadrics[quadric]
                                .distance(origin, direction, start, double{t_far}));
}

void intersect_quadric(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayHit& asked = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const PlainContext& ray = *reinterpret_cast<const PlainContext*>(arguments->context);
  const float t = distance(arguments->geometryUserPtr, arguments->primID, ray.origin, ray.direction, asked.ray.tfar);
  if (t < asked.ray.tfar) {
    asked.ray.tfar = t;
    asked.hit.primID = arguments->primID;
    asked.hit.geomID = arguments->geomID;
  }
}

void occlude_quadric(const RTCOccludedFunctionNArguments* arguments) {
  RTCRay& asked = *reinterpret_cast<RTCRay*>(arguments->ray);
  const core::Vec3f origin{asked.org_x, asked.org_y, asked.org_z}, direction{asked.dir_x, asked.dir_y, asked.dir_z};
  if (distance(arguments->geometryUserPtr, arguments->primID, core::Vec3d(origin), core::Vec3d(direction), asked.tfar) <
      asked.tfar) {
    asked.tfar = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

PlainShapes::PlainShapes(std::span<const core::PrimitiveValues> given) : Shapes(given) {
  for (const std::uint32_t id : curved) {
    quadrics.emplace_back(primitives[id]);
  }
}

EmbreeTree::EmbreeTree(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode)
    : shapes_(primitives),
      tree_(mode == EmbreeMode::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_HIGH) {
  if (!shapes_.triangles.empty()) {
    tree_.attach(embree::triangle_mesh(tree_.device(), shapes_));
  }
  if (!shapes_.curved.empty()) {
    tree_.attach(embree::curved_geometry(tree_.device(), shapes_, intersect_quadric, occlude_quadric));
  }
  DoubleStopwatch stopwatch;
  tree_.build();
  build_times_ = stopwatch.lap();
}

std::uint64_t EmbreeTree::trace(std::span<const core::Ray> rays, Query query) const {
  PlainContext context;
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    if (query == Query::any) {
      RTCRay asked = embree::ray_of(ray);
      embree::occlude(library_, tree_.scene(), context.embree, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      context.origin = core::Vec3d(ray.origin);
      context.direction = core::Vec3d(ray.direction);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(library_, tree_.scene(), context.embree, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

}  // namespace dmpc::apps
