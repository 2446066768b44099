// Some neighbouring pixels under way: their rays of one kind walk together, run against any tracer of bundles.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/base/expect.h"
#include "core/picture/pixel_task.h"
#include "core/trace/bundle.h"

namespace dmpc::core {

/// Finds what the rays of a bundle hit, and the records that shading reads. trace() has the contract of
/// core/trace/bundle_walk.h's.
template <class T>
concept BundleTracer = requires(T& tracer, RayBundle& bundle, Operations& operations, Address address) {
  { tracer.trace(bundle, operations) } -> std::same_as<bool>;
  { tracer.find(address) } -> std::same_as<const std::byte*>;
};

/// The hits of a bundle's rays, being shaded side by side: all read what they are, then each light sends its bundle of shadow
/// rays, then the mirrored rays are a bundle, then the refracted ones.
struct BundleHit {
  enum class Phase : std::uint8_t { surface, light, reflected, refracted, finished };

  std::array<HitState, bundle_rays_max> hit;
  std::array<std::uint8_t, bundle_rays_max> place;  ///< of the hit's pixel
  std::uint32_t count = 0;
  std::uint32_t next = 0;   ///< the hit that goes on next, while surfaces are read
  std::uint32_t light = 0;  ///< whose shadow rays are next
  Phase phase = Phase::surface;

  bool has_unread_surface() const {
    return std::any_of(hit.begin(), hit.begin() + count,
                       [](const HitState& state) { return state.stage < HitState::Stage::light; });
  }
};

/// Renders samples of up to 16 pixels, or more samples of one: 16 rays at a time. Depth first, last in first out: a bundle's
/// hits are shaded one bundle of children at a time, and each is traced to its end before the next is made, so the stack holds at
/// most one BundleHit a depth. Lives in memory given by its owner; never allocates. Copyable as bytes. The deposits are those of
/// PixelTask, in another order, which sums do not know.
class BundleTask {
 public:
  static constexpr std::uint32_t pixels_max = bundle_rays_max;
  using Hits = BundleHit;  ///< an entry of the stack

  /// `stack` has at least settings.shade.depth_max entries and outlives the task.
  explicit BundleTask(std::span<BundleHit> stack) : stack_(stack) {}

  /// Of each of `pixels`, at most 16; only one, if there are more than 16 samples of them all.
  void start(std::span<const std::uint32_t> pixels, const SampleRange& samples, const RenderSettings& settings,
             Operations& operations);

  /// Goes on until the pixels are finished, a bundle has ended (`more`), or a record is absent (see absent()). One call ends
  /// at most one bundle, so it is a bounded quantum.
  template <BundleTracer T>
  TaskState run(T& tracer, const RenderSettings& settings, Operations& operations);

  Address absent() const { return absent_; }
  /// Rays that a run() which returned `more` has ended.
  std::uint32_t rays_ended() const { return ended_; }
  std::uint32_t pixel_count() const { return pixel_count_; }
  std::uint32_t pixel(std::uint32_t place = 0) const { return pixels_[place]; }
  const PixelSums& sums(std::uint32_t place = 0) const { return sums_[place]; }
  /// The first of those under way, or that ended last.
  const Ray& ray() const { return bundle_.rays[0]; }

 private:
  using Phase = BundleHit::Phase;

  template <BundleTracer T>
  TaskState shade(T& tracer, const RenderSettings& settings, Operations& operations);
  template <BundleTracer T>
  bool read_surfaces(T& tracer, BundleHit& hits, const RenderSettings& settings, Operations& operations);
  template <BundleTracer T>
  bool shoot_at_light(T& tracer, BundleHit& hits, const RenderSettings& settings, Operations& operations);

  bool next_samples(const RenderSettings& settings, Operations& operations);
  void shoot_primary(std::uint32_t place, std::uint32_t sample, const RenderSettings& settings, Operations& operations);
  void shoot_children(BundleHit& hits, HitState::Stage stage, const std::byte* record, const RenderSettings& settings,
                      Operations& operations);
  static void next_phase(BundleHit& hits, const RenderSettings& settings);
  void add_ray(const Ray& ray, std::uint32_t place, Operations& operations);
  bool begin_tracing();
  void end_rays(const RenderSettings& settings, Operations& operations);

  std::span<BundleHit> stack_;
  std::array<std::uint32_t, pixels_max> pixels_;
  std::array<PixelSums, pixels_max> sums_;
  std::array<std::uint8_t, bundle_rays_max> place_;  ///< of the pixel of each of the bundle's rays
  std::uint32_t pixel_count_ = 0;
  std::uint32_t sample_ = 0, sample_end_ = 0;
  std::uint32_t stack_size_ = 0;
  std::uint32_t ended_ = 0;
  Address absent_ = no_address;
  bool tracing_ = false;
  RayBundle bundle_;
};

template <BundleTracer T>
TaskState BundleTask::run(T& tracer, const RenderSettings& settings, Operations& operations) {
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

/// Shades the newest hits until they yield a bundle to be traced, or samples have ended that meet nothing (`more`), an absent
/// record is needed, or no hit and no sample is left.
template <BundleTracer T>
TaskState BundleTask::shade(T& tracer, const RenderSettings& settings, Operations& operations) {
  while (stack_size_ > 0) {
    BundleHit& hits = stack_[stack_size_ - 1];
    switch (hits.phase) {
      case Phase::surface:
        if (!read_surfaces(tracer, hits, settings, operations)) {
          return TaskState::absent;
        }
        break;
      case Phase::light:
        if (!shoot_at_light(tracer, hits, settings, operations)) {
          return TaskState::absent;
        }
        break;
      case Phase::reflected:
        shoot_children(hits, HitState::Stage::reflected, nullptr, settings, operations);
        break;
      case Phase::refracted:
        shoot_children(hits, HitState::Stage::refracted, nullptr, settings, operations);
        break;
      case Phase::finished:
        --stack_size_;
        continue;
    }
    next_phase(hits, settings);
    if (begin_tracing()) {
      return TaskState::more;
    }
  }
  return next_samples(settings, operations) ? TaskState::more : TaskState::finished;
}

/// Round by round a step of each hit, so that neighbours, which often need one record, find it together. False if one is absent.
template <BundleTracer T>
bool BundleTask::read_surfaces(T& tracer, BundleHit& hits, const RenderSettings& settings, Operations& operations) {
  const Shader shader(settings.header, settings.shade, settings.skips, operations);
  Address found = no_address;
  const std::byte* record = nullptr;
  for (; hits.has_unread_surface(); hits.next = 0) {
    for (; hits.next < hits.count; ++hits.next) {
      HitState& state = hits.hit[hits.next];
      if (state.stage >= HitState::Stage::light) {
        continue;
      }
      absent_ = record_needed(state, settings.header);
      operations.skipped.bundles += absent_ == found ? 1 : 0;
      record = absent_ == found ? record : tracer.find(absent_);
      if (record == nullptr) {
        return false;
      }
      found = absent_;
      Ray none;
      shader.step(state, record, none);
    }
  }
  return true;
}

/// The light's record is read once for all hits. False if it is absent.
template <BundleTracer T>
bool BundleTask::shoot_at_light(T& tracer, BundleHit& hits, const RenderSettings& settings, Operations& operations) {
  absent_ = advance(settings.header.lights, hits.light * sizeof(LightRecord));
  const std::byte* const record = tracer.find(absent_);
  if (record == nullptr) {
    return false;
  }
  operations.skipped.bundles += hits.count - 1;
  shoot_children(hits, HitState::Stage::light, record, settings, operations);
  return true;
}

}  // namespace dmpc::core
