#include "core/picture/bundle_task.h"

#include <algorithm>
#include <type_traits>

namespace dmpc::core {

/// run() generates the first rays, as all others.
template <class Bundle>
void BundleTaskWith<Bundle>::start(std::span<const std::uint32_t> pixels, std::span<const SampleStep> steps,
                                   const RenderSettings& settings, Operations&) {
  expect((settings.header.has_instances != 0) == std::is_same_v<Bundle, InstanceBundle>,
         "a bundle is one that the database's walk takes");
  expect(stack_.size() >= static_cast<std::size_t>(waiting_hits_max(settings.shade, settings.skips)),
         "the ray stack holds the hits that wait");
  expect(!pixels.empty() && pixels.size() <= pixels_max && pixels.size() == steps.size(), "a task has up to 16 pixels");
  std::copy(pixels.begin(), pixels.end(), pixels_.begin());
  std::copy(steps.begin(), steps.end(), steps_.begin());
  pixel_count_ = static_cast<std::uint8_t>(pixels.size());
  std::fill_n(sums_.begin(), pixel_count_, PixelSums{});
  next_place_ = 0;
  sample_ = samples(0, settings).first;
  stack_size_ = 0;
  tracing_ = false;
  bundle_.count = 0;
}

/// When no hit is left to shade, goes on with the next samples, if there are any.
template <class Bundle>
bool BundleTaskWith<Bundle>::next_samples(const RenderSettings& settings, Operations& operations) {
  if (next_place_ == pixel_count_) {
    return false;
  }
  for (std::uint32_t shot = 0; shot < bundle_rays_max && next_place_ < pixel_count_; ++shot) {
    shoot_primary(next_place_, sample_++, settings, operations);
    const SampleRange range = samples(next_place_, settings);
    if (sample_ == range.first + range.count && ++next_place_ < pixel_count_) {
      sample_ = samples(next_place_, settings).first;
    }
  }
  begin_tracing();
  return true;
}

template <class Bundle>
void BundleTaskWith<Bundle>::shoot_primary(std::uint32_t place, std::uint32_t sample, const RenderSettings& settings,
                                           Operations& operations) {
  if (!settings.shows_background(pixels_[place])) {
    bundle_.rays[bundle_.count] = settings.camera.primary_ray(pixels_[place], sample);
    add_ray(place, operations);
    return;
  }
  ++operations.rays[static_cast<std::size_t>(RayKind::primary)];
  ++operations.skipped.background;
  ++ended_;
  const Ray ray = settings.missing_ray(pixels_[place], sample);
  deposit(sums_[place], ray, settings.light_of_miss(ray), settings, operations);
}

/// The next ray of the bundle, which has been set.
template <class Bundle>
void BundleTaskWith<Bundle>::add_ray(std::uint32_t place, Operations& operations) {
  ++operations.rays[static_cast<std::size_t>(bundle_.rays[bundle_.count].kind)];
  place_[bundle_.count++] = static_cast<std::uint8_t>(place);
}

/// Returns whether there are rays to trace, which become the current bundle.
template <class Bundle>
bool BundleTaskWith<Bundle>::begin_tracing() {
  tracing_ = bundle_.count > 0;
  bundle_.start();
  return tracing_;
}

/// The slot for the next hits, that of those which need nothing more.
template <class Bundle>
BundleHit& BundleTaskWith<Bundle>::fresh_hits() {
  stack_size_ = static_cast<std::uint8_t>(waiting_count(stack_, stack_size_));
  expect(stack_size_ < stack_.size(), "the ray stack holds the hits that wait");
  stack_[stack_size_].clear();
  return stack_[stack_size_];
}

/// Handles traced rays: deposits light on the film, or pushes hits on the stack.
template <class Bundle>
void BundleTaskWith<Bundle>::end_rays(const RenderSettings& settings, Operations& operations) {
  const bool is_shadow = bundle_.rays[0].kind == RayKind::shadow;
  BundleHit* const hits = is_shadow ? nullptr : &fresh_hits();
  for (std::uint32_t i = 0; i < bundle_.count; ++i) {
    const Ray& ray = bundle_.rays[i];
    const bool is_hit = (bundle_.found >> i & 1U) != 0;
    if (!is_hit && settings.asks_sky(ray)) {
      hits->add_sky(ray, place_[i]);
    } else if (const auto light = light_of_ended(ray, is_hit, settings, operations)) {
      deposit(sums_[place_[i]], ray, *light, settings, operations);
    } else if (!is_shadow) {
      hits->add(ray, bundle_.best.of(i), place_[i]);
    }
  }
  if (hits != nullptr && hits->count > 0) {
    ++stack_size_;
  }
  ended_ = static_cast<std::uint16_t>(ended_ + bundle_.count);
  bundle_.count = 0;
  tracing_ = false;
}

template class BundleTaskWith<RayBundle>;
template class BundleTaskWith<InstanceBundle>;

}  // namespace dmpc::core
