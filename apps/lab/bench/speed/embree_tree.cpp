#include "apps/lab/bench/speed/embree_tree.h"

#include <limits>

namespace dmpc::apps {

namespace {

/// Returns where the only ray of a query meets the quadric, NaN if nowhere. Rays start so near to the curved surface that they
/// leave that Embree's floats cannot distinguish the sides.
float distance(void* shapes, unsigned quadric, const RTCRay& ray) {
  constexpr float share = 0x1p-16F;
  const core::Vec3f origin{ray.org_x, ray.org_y, ray.org_z}, direction{ray.dir_x, ray.dir_y, ray.dir_z};
  const float start = share * largest_component(origin) / largest_component(direction);
  return static_cast<float>(static_cast<const PlainShapes*>(static_cast<embree::Shapes*>(shapes))
                                ->quadrics[quadric]
                                .distance(core::Vec3d(origin), core::Vec3d(direction), double{start}, double{ray.tfar}));
}

void intersect_quadric(const RTCIntersectFunctionNArguments* arguments) {
  RTCRayHit& asked = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const float t = distance(arguments->geometryUserPtr, arguments->primID, asked.ray);
  if (t < asked.ray.tfar) {
    asked.ray.tfar = t;
    asked.hit.primID = arguments->primID;
    asked.hit.geomID = arguments->geomID;
  }
}

void occlude_quadric(const RTCOccludedFunctionNArguments* arguments) {
  RTCRay& asked = *reinterpret_cast<RTCRay*>(arguments->ray);
  if (distance(arguments->geometryUserPtr, arguments->primID, asked) < asked.tfar) {
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
