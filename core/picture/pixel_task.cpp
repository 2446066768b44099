#include "core/picture/pixel_task.h"

#include <type_traits>

#include "core/base/expect.h"

namespace dmpc::core {

template <class RayCursor>
void PixelTaskWith<RayCursor>::start(std::uint32_t pixel, const SampleRange& samples, const RenderSettings& settings,
                                     Operations& operations) {
  expect(stack_.size() >= static_cast<std::size_t>(waiting_hits_max(settings.shade, settings.skips)),
         "the ray stack holds the hits that wait");
  expect((settings.header.has_instances != 0) == std::is_same_v<RayCursor, InstanceCursor>,
         "a pixel's rays have the cursor that the database's walk takes");
  pixel_ = pixel;
  sample_ = samples.first;
  sample_end_ = samples.first + samples.count;
  sums_ = {};
  stack_size_ = 0;
  shows_background_ = settings.shows_background(pixel);
  shoot_primary(settings, operations);
}

template <class RayCursor>
void PixelTaskWith<RayCursor>::shoot_primary(const RenderSettings& settings, Operations& operations) {
  if (shows_background_) {
    shoot(settings.missing_ray(pixel_, sample_), operations);
    ++operations.skipped.background;
  } else {
    shoot(settings.camera.primary_ray(pixel_, sample_), operations);
  }
}

template <class RayCursor>
void PixelTaskWith<RayCursor>::shoot(const Ray& ray, Operations& operations) {
  ray_ = ray;
  cursor_ = {};
  tracing_ = true;
  ++operations.rays[static_cast<std::size_t>(ray.kind)];
}

/// The slot of a hit that needs nothing more.
template <class RayCursor>
void PixelTaskWith<RayCursor>::push(const HitState& hit) {
  stack_size_ = waiting_count(stack_, stack_size_);
  expect(stack_size_ < stack_.size(), "the ray stack holds the hits that wait");
  stack_[stack_size_++] = hit;
}

/// Handles a traced ray: deposits light on the film, or pushes a hit on the stack.
template <class RayCursor>
void PixelTaskWith<RayCursor>::end_ray(Traced result, const RenderSettings& settings, Operations& operations) {
  expect(result == Traced::hit || result == Traced::miss, "a pixel's tracer sees the whole scene");
  tracing_ = false;
  if (result == Traced::miss && settings.asks_sky(ray_)) {
    push(begin_sky(ray_));
  } else if (const auto light = light_of_ended(ray_, result == Traced::hit, settings, operations)) {
    deposit(sums_, ray_, *light, settings, operations);
  } else if (ray_.kind != RayKind::shadow) {
    push(begin_shading(ray_, cursor_.best));
  }
}

/// When no hit is left to shade, goes on with the next sample, if there is one.
template <class RayCursor>
bool PixelTaskWith<RayCursor>::next_sample(const RenderSettings& settings, Operations& operations) {
  if (++sample_ == sample_end_) {
    return false;
  }
  shoot_primary(settings, operations);
  return true;
}

template class PixelTaskWith<Cursor>;
template class PixelTaskWith<InstanceCursor>;

}  // namespace dmpc::core
