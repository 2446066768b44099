#include "core/picture/bundle_task.h"

#include <algorithm>

namespace dmpc::core {

/// The first rays are shot by run(), as all others are.
void BundleTask::start(std::span<const std::uint32_t> pixels, const SampleRange& samples, const RenderSettings& settings,
                       Operations&) {
  expect(stack_.size() >= static_cast<std::size_t>(settings.shade.depth_max), "the ray stack holds a hit a depth");
  expect(
      !pixels.empty() && pixels.size() <= pixels_max && (pixels.size() == 1 || pixels.size() * samples.count <= bundle_rays_max),
      "a bundle has a ray for each sample of several pixels");
  std::copy(pixels.begin(), pixels.end(), pixels_.begin());
  pixel_count_ = static_cast<std::uint32_t>(pixels.size());
  std::fill_n(sums_.begin(), pixel_count_, PixelSums{});
  sample_ = samples.first;
  sample_end_ = samples.first + samples.count;
  stack_size_ = 0;
  tracing_ = false;
  bundle_.count = 0;
}

/// With no hit left to shade: the next samples, if there are any.
bool BundleTask::next_samples(const RenderSettings& settings, Operations& operations) {
  if (sample_ == sample_end_) {
    return false;
  }
  const std::uint32_t count = std::min(pixels_max / pixel_count_, sample_end_ - sample_);
  for (std::uint32_t place = 0; place < pixel_count_; ++place) {
    for (std::uint32_t sample = sample_; sample < sample_ + count; ++sample) {
      shoot_primary(place, sample, settings, operations);
    }
  }
  sample_ += count;
  begin_tracing();
  return true;
}

void BundleTask::shoot_primary(std::uint32_t place, std::uint32_t sample, const RenderSettings& settings,
                               Operations& operations) {
  if (!settings.shows_background(pixels_[place])) {
    add_ray(settings.camera.primary_ray(pixels_[place], sample), place, operations);
    return;
  }
  ++operations.rays[static_cast<std::size_t>(RayKind::primary)];
  ++operations.skipped.background;
  ++ended_;
  const Ray ray{.pixel = pixels_[place], .sample = sample};
  deposit(sums_[place], ray, ray.weight * settings.header.background, settings, operations);
}

void BundleTask::add_ray(const Ray& ray, std::uint32_t place, Operations& operations) {
  bundle_.rays[bundle_.count] = ray;
  place_[bundle_.count++] = static_cast<std::uint8_t>(place);
  ++operations.rays[static_cast<std::size_t>(ray.kind)];
}

/// Returns whether there are rays to be traced, which then are under way.
bool BundleTask::begin_tracing() {
  tracing_ = bundle_.count > 0;
  bundle_.start();
  return tracing_;
}

/// What traced rays leave: light on the film, or hits on the stack.
void BundleTask::end_rays(const RenderSettings& settings, Operations& operations) {
  const bool is_shadow = bundle_.rays[0].kind == RayKind::shadow;
  expect(is_shadow || stack_size_ < stack_.size(), "the ray stack holds a hit a depth");
  BundleHit* const hits = is_shadow ? nullptr : &stack_[stack_size_];
  if (!is_shadow) {
    hits->clear();
  }
  for (std::uint32_t i = 0; i < bundle_.count; ++i) {
    const Ray& ray = bundle_.rays[i];
    if (const auto light = light_of_ended(ray, (bundle_.found >> i & 1U) != 0, settings, operations)) {
      deposit(sums_[place_[i]], ray, *light, settings, operations);
    } else if (!is_shadow) {
      hits->add(ray, bundle_.best.of(i), place_[i]);
    }
  }
  stack_size_ += hits != nullptr && hits->count > 0 ? 1 : 0;
  ended_ += bundle_.count;
  bundle_.count = 0;
  tracing_ = false;
}

}  // namespace dmpc::core
