#include "apps/lab/bench/speed/rival.h"

#include <algorithm>

#include "apps/lab/bench/speed/embree_tree.h"

namespace dmpc::apps {
namespace {

/// Up to 16 rays as Embree takes them, side by side.
struct FilledPacket {
  embree::Packet packet;
  RTCRayHit16 asked{};

  void fill(std::span<const core::Ray> rays) {
    std::fill(std::fill_n(packet.valid.begin(), rays.size(), -1), packet.valid.end(), 0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      set(i, embree::ray_of(rays[i]));
    }
  }

 private:
  void set(std::size_t i, const RTCRay& ray) {
    RTCRay16& rays = asked.ray;
    rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
    rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
    rays.tnear[i] = ray.tnear, rays.tfar[i] = ray.tfar, rays.mask[i] = ray.mask;
    asked.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
};

}  // namespace

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

std::uint64_t EmbreeRival::trace_packets(const BundleSpan& bundles, Query query, Coherence coherence) const {
  embree::Context context;
  embree::start(context);
  FilledPacket filled;
  filled.packet.is_coherent = coherence == Coherence::coherent;
  std::uint64_t hits = 0;
  for (std::size_t i = 0; i < bundles.count(); ++i) {
    const auto count = static_cast<std::ptrdiff_t>(bundles.bundle(i).size());
    filled.fill(bundles.bundle(i));
    if (query == Query::any) {
      embree::occlude(tree_->library(), tree_->scene(), context, filled.packet, filled.asked.ray);
      const float* const ends = filled.asked.ray.tfar;
      hits += static_cast<std::uint64_t>(std::count_if(ends, ends + count, [](float end) { return end < 0; }));
    } else {
      embree::intersect(tree_->library(), tree_->scene(), context, filled.packet, filled.asked);
      const unsigned* const met = filled.asked.hit.geomID;
      hits += static_cast<std::uint64_t>(count - std::count(met, met + count, RTC_INVALID_GEOMETRY_ID));
    }
  }
  return hits;
}

Times EmbreeRival::build_times() const { return tree_->build_times(); }

}  // namespace dmpc::apps
