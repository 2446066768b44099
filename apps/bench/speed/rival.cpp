#include "apps/bench/speed/rival.h"

#include "apps/bench/speed/embree_tree.h"

namespace dmpc::apps {

EmbreeRival::EmbreeRival(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
                         std::uint32_t thread_count)
    : tree_(std::make_unique<EmbreeTree>(primitives, mode, quality, thread_count)) {}

EmbreeRival::~EmbreeRival() = default;

std::uint64_t EmbreeRival::trace(std::span<const core::Ray> rays, Query query) const {
  embree::Context context;
  embree::start(context);
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    if (query == Query::any) {
      RTCRay asked = embree::ray_of(ray);
      embree::occlude(tree_->library(), tree_->scene(), context, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(tree_->library(), tree_->scene(), context, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

Times EmbreeRival::build_times() const { return tree_->build_times(); }

}  // namespace dmpc::apps
