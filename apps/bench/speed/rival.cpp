#include "apps/bench/speed/rival.h"

#include "apps/bench/speed/embree_tree.h"

namespace dmpc::apps {

struct EmbreeRival::Parts {
  EmbreeTree tree;
};

EmbreeRival::EmbreeRival(std::span<const core::PrimitiveValues> primitives, EmbreeMode mode, EmbreeQuality quality,
                         std::uint32_t thread_count)
    : parts_(new Parts{{primitives, mode, quality, thread_count}}) {}

EmbreeRival::~EmbreeRival() = default;

std::uint64_t EmbreeRival::trace(std::span<const core::Ray> rays, Query query) const {
  embree::Context context;
  embree::start(context);
  std::uint64_t hits = 0;
  for (const core::Ray& ray : rays) {
    if (query == Query::any) {
      RTCRay asked = embree::ray_of(ray);
      embree::occlude(parts_->tree.library(), parts_->tree.scene(), context, asked);
      hits += asked.tfar < 0 ? 1 : 0;
    } else {
      RTCRayHit asked;
      asked.ray = embree::ray_of(ray);
      asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      embree::intersect(parts_->tree.library(), parts_->tree.scene(), context, asked);
      hits += asked.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
    }
  }
  return hits;
}

Times EmbreeRival::build_times() const { return parts_->tree.build_times(); }

}  // namespace dmpc::apps
