// Several neighbouring pixels in progress: their rays of one kind are traced together by any tracer of bundles.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/hits/bundle_hit.h"
#include "core/picture/pixel_task.h"
#include "core/trace/bundle.h"
#include "core/trace/bundle_below.h"
#include "core/trace/instance_bundle.h"

namespace dmpc::core {

/// Renders samples of up to 16 pixels, each with its own step: 16 rays at a time, those of a pixel one after the other, so that
/// bundles are full however few samples each pixel needs. Depth first, last in first out: a bundle's hits are shaded one bundle
/// of children at a time, each is traced to its end before the next is made, and hits are popped for their last one, so the stack
/// holds at most one BundleHit per depth, with paths one. Lives in memory given by its owner; never allocates. Copyable as bytes.
/// The deposits are those of PixelTask in another order, on which sums do not depend. `Bundle`: RayBundle, or InstanceBundle,
/// which is longer, for a database with instances.
template <class Bundle>
class BundleTaskWith {
 public:
  static constexpr std::uint32_t pixels_max = bundle_rays_max;
  using Hits = BundleHit;  ///< an entry of the stack

  /// `stack` has at least waiting_hits_max() entries and outlives the task.
  explicit BundleTaskWith(std::span<BundleHit> stack) : stack_(stack) {}

  /// Starts rendering `pixels`, at most 16, with as many steps, each of which adds samples.
  void start(std::span<const std::uint32_t> pixels, std::span<const SampleStep> steps, const RenderSettings& settings,
             Operations& operations);

  /// Goes on until the pixels are finished, a bundle has ended (`more`), or a record is absent (see absent()). One call ends
  /// at most one bundle, so it is a bounded quantum.
  template <BundleTracer T>
  TaskState run(T& tracer, const RenderSettings& settings, Operations& operations);

  Address absent() const { return absent_; }
  // As those of PixelTask:
  bool is_tracing() const { return tracing_; }
  /// Calls ask(ray, below, number of rays after it) for each ray that waits for what lies below the absent record.
  template <class Ask>
  void for_each_below(const Ask& ask) const {
    std::uint32_t left = count_of(bundle_.next_rays);
    for (RayMask rays = bundle_.next_rays; rays != 0; rays &= rays - 1) {
      const auto ray = static_cast<std::uint32_t>(std::countr_zero(rays));
      ask(ray, core::below(bundle_, ray), --left);
    }
  }
  /// Takes what a ray has found there. Returns whether none waits any more: run() goes on after it.
  bool take_below(std::uint32_t ray, const Hit& found, Operations& operations) {
    expect(tracing_, "a traversal is what waits for what lies below");
    return core::take_below(bundle_, ray, found, operations);
  }
  RecordKind absent_kind() const {
    const BundleHit* const hits = tracing_ ? nullptr : &stack_[stack_size_ - 1U];
    return hits != nullptr          ? record_kind_of(hits->hit[hits->next])
           : bundle_.next.is_leaf() ? RecordKind::leaf
                                    : RecordKind::bvh_node;
  }
  /// Number of rays that ended in the last run() that returned `more`.
  std::uint32_t rays_ended() const { return ended_; }
  std::uint32_t pixel_count() const { return pixel_count_; }
  std::uint32_t pixel(std::uint32_t place = 0) const { return pixels_[place]; }
  const PixelSums& sums(std::uint32_t place = 0) const { return sums_[place]; }
  /// The first ray in progress, or the last that ended.
  const Ray& ray() const { return bundle_.rays[0]; }

 private:
  template <BundleTracer T>
  TaskState shade(T& tracer, const RenderSettings& settings, Operations& operations);

  bool next_samples(const RenderSettings& settings, Operations& operations);
  SampleRange samples(std::uint32_t place, const RenderSettings& settings) const {
    return steps_[place].samples(settings.first_samples().count);
  }
  void shoot_primary(std::uint32_t place, std::uint32_t sample, const RenderSettings& settings, Operations& operations);
  void add_ray(std::uint32_t place, Operations& operations);
  bool begin_tracing();
  BundleHit& fresh_hits();
  void end_rays(const RenderSettings& settings, Operations& operations);

  std::span<BundleHit> stack_;
  std::array<std::uint32_t, pixels_max> pixels_;
  std::array<PixelSums, pixels_max> sums_;
  std::array<std::uint8_t, bundle_rays_max> place_;  ///< the pixel's slot of each ray of the bundle
  std::array<SampleStep, pixels_max> steps_;         ///< each pixel's
  Address absent_ = no_address;
  std::uint32_t sample_ = 0;  ///< first sample of the next round, of the pixel at next_place_
  std::uint16_t ended_ = 0;
  std::uint8_t pixel_count_ = 0, next_place_ = 0;
  std::uint8_t stack_size_ = 0;  ///< at most one entry per depth
  bool tracing_ = false;
  Bundle bundle_;
};

extern template class BundleTaskWith<RayBundle>;
extern template class BundleTaskWith<InstanceBundle>;

using BundleTask = BundleTaskWith<RayBundle>;
using InstanceBundleTask = BundleTaskWith<InstanceBundle>;

template <class Bundle>
template <BundleTracer T>
TaskState BundleTaskWith<Bundle>::run(T& tracer, const RenderSettings& settings, Operations& operations) {
  if (!tracing_) {
    ended_ = 0;
    const TaskState shaded = shade(tracer, settings, operations);
    if (shaded != TaskState::more || !tracing_) {
      return shaded;
    }
  }
  if (!tracer.trace(bundle_, operations)) {
    absent_ = bundle_.absent;
    return TaskState::absent;
  }
  end_rays(settings, operations);
  return TaskState::more;
}

/// Shades the newest hits until they yield a bundle to be traced, or samples have ended that hit nothing (`more`), an absent
/// record is needed, or no hit and no sample is left.
template <class Bundle>
template <BundleTracer T>
TaskState BundleTaskWith<Bundle>::shade(T& tracer, const RenderSettings& settings, Operations& operations) {
  while ((stack_size_ = static_cast<std::uint8_t>(waiting_count(stack_, stack_size_))) > 0) {
    BundleHit& hits = stack_[stack_size_ - 1];
    const auto shoot = [&](std::uint32_t i, const auto& make) {
      if (make(bundle_.rays[bundle_.count])) {
        add_ray(hits.place[i], operations);
      }
    };
    const auto shine = [&](const Color& light, std::uint32_t i) {
      deposit(sums_[hits.place[i]], hits.hit[i].ray, light, settings, operations);
    };
    if (!BundleShader<T>(hits, tracer, settings, operations).step(absent_, shoot, shine)) {
      return TaskState::absent;
    }
    if (begin_tracing()) {
      return TaskState::more;
    }
  }
  return next_samples(settings, operations) ? TaskState::more : TaskState::finished;
}

}  // namespace dmpc::core
