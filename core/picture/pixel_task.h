// One pixel in progress: a bounded stack of hits and one ray, run with any tracer until it ends or needs an absent record.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "core/base/expect.h"
#include "core/picture/camera/background.h"
#include "core/picture/camera/camera.h"
#include "core/picture/film/film.h"
#include "core/picture/sampling/refinement.h"
#include "core/picture/shade.h"
#include "core/trace/below.h"
#include "core/trace/below_in_mesh.h"
#include "core/trace/bundle_traversal.h"
#include "core/trace/instance_traversal.h"
#include "core/trace/operations.h"
#include "core/trace/task_state.h"
#include "core/trace/traversal.h"

namespace dmpc::core {

/// Finds a ray's hit, and the records that shading reads. trace() has the contract of core/trace/traversal.h.
template <class T>
concept Tracer = requires(T& tracer, const Ray& ray, Cursor& cursor, Operations& operations, Address address) {
  { tracer.trace(ray, cursor, operations) } -> std::same_as<Traced>;
  { tracer.find(address) } -> std::same_as<const std::byte*>;
};

/// Our grid over any memory: the tracer of svm (records = the pager) and of replicated (records = the whole database).
template <Records R>
class GridTracer {
 public:
  GridTracer(R& records, const DatabaseHeader& header, const Skips& skips) : records_(&records), header_(header), skips_(skips) {}
  Traced trace(const Ray& ray, Cursor& cursor, Operations& operations) {
    return core::trace(ray, cursor, *records_, header_, skips_, operations);
  }
  /// For a database with instances.
  Traced trace(const Ray& ray, InstanceCursor& cursor, Operations& operations) {
    return core::trace(ray, cursor, *records_, header_, skips_, operations);
  }
  /// Traces with the caller's test of leaves: test(record, address, best).
  template <class Test>
  Traced trace(const Ray& ray, Cursor& cursor, Operations& operations, const Test& test) {
    return RayTraversal(ray, cursor, *records_, operations).trace(header_, skips_, meet_children, test);
  }
  /// Traces the rays of a bundle.
  bool trace(RayBundle& bundle, Operations& operations) { return core::trace(bundle, *records_, header_, skips_, operations); }
  bool trace(InstanceBundle& bundle, Operations& operations) {
    return core::trace(bundle, *records_, header_, skips_, operations);
  }
  const std::byte* find(Address address) { return records_->find(address); }
  /// The region that rays traverse: the header's, or that of the last move_to().
  const Region& region() const { return header_.region; }
  /// Changes the region; the records include those of this region.
  void move_to(const Region& region) { header_.region = region; }

 private:
  R* records_;
  DatabaseHeader header_;
  Skips skips_;
};

/// What a pixel needs in addition to the records; copied to every node.
struct RenderSettings {
  DatabaseHeader header;
  Camera camera;  ///< includes the number of samples of the first pass
  ShadeOptions shade;
  RefinementOptions refinement;
  Skips skips;
  BackgroundTiles background;  ///< find_background() of the database and the camera, if known

  /// Whether the background is the same for all rays that hit nothing.
  bool is_beyond_alike() const { return !shade.transport.has_gradient && !has_sky_picture(header); }
  /// Whether a ray that hits nothing reads its light from a record.
  bool asks_sky(const Ray& ray) const { return has_sky_picture(header) && ray.kind != RayKind::shadow; }
  /// Whether the pixel's primary rays are certain to miss, and need not be traced.
  bool shows_background(std::uint32_t pixel) const { return skips.background && background.has(pixel); }
  /// Settings of this picture for a tracer that has to trace every ray.
  RenderSettings with_every_ray_traced() const {
    RenderSettings settings = *this;
    settings.skips.background = false;
    return settings;
  }
  /// What refinement needs to know of the scene, in addition to the film; empty if no refinement is wanted.
  FineDetail fine_detail(const Database& database) const {
    return refinement.is_wanted() ? find_fine_detail(database, camera) : FineDetail();
  }
  /// The radiance for a ray that hits nothing, is no shadow ray, and does not read the sky's picture.
  Color light_beyond(const Ray& ray) const {
    const Transport& transport = shade.transport;
    if (transport.has_sky) {
      return sky_light(transport, header.background, ray.direction);
    }
    return ray.kind == RayKind::scattered ? Color{} : header.background;
  }
  /// The light that a ray that hits nothing adds to its pixel: for a shadow ray its weight, otherwise the background.
  Color light_of_miss(const Ray& ray) const { return ray.kind == RayKind::shadow ? ray.weight : ray.weight * light_beyond(ray); }
  /// A primary ray that is known to miss: has its direction if light_beyond() needs it.
  Ray missing_ray(std::uint32_t pixel, std::uint32_t sample) const {
    return shade.transport.has_gradient ? camera.primary_ray(pixel, sample)
                                        : Ray{.pixel = pixel, .sample = static_cast<std::uint16_t>(sample)};
  }
  SampleRange first_samples() const { return {0, static_cast<std::uint32_t>(camera.samples())}; }
  Pass first_pass() const { return {camera.pixel_count(), first_samples().count}; }
};

/// Adds what the ray's sample finds to its pixel's sums.
inline void deposit(PixelSums& sums, const Ray& ray, const Color& light, const RenderSettings& settings, Operations& operations) {
  const Color counted = clamped(ray, light, settings.shade);
  if (add(sums.plane[plane_of(ray.sample)], to_fixed(counted, settings.shade.film_scale))) {
    ++operations.deposits_saturated;
  }
}

/// The sums of `pixels` pixels of settings.background, with the samples of the first pass; counted as if a task had rendered
/// each. Requires settings.shows_background() for them, and settings.is_beyond_alike(). Thread safety: pure except for the
/// counts.
inline PixelSums background_sums(std::uint64_t pixels, const RenderSettings& settings, Operations& operations) {
  const SampleRange samples = settings.first_samples();
  PixelSums sums;
  Operations of_one;
  for (std::uint32_t i = 0; i < samples.count; ++i) {
    const Ray ray{.sample = static_cast<std::uint16_t>(samples.first + i)};
    deposit(sums, ray, settings.light_of_miss(ray), settings, of_one);
  }
  operations.rays[static_cast<std::size_t>(RayKind::primary)] += pixels * samples.count;
  operations.skipped.background += pixels * samples.count;
  operations.deposits_saturated += pixels * of_one.deposits_saturated;
  return sums;
}

/// The light that a traced ray adds to its pixel. None if a shadow ray was blocked, or the hit of another ray is to be shaded.
/// Requires that it does not read the sky's picture.
inline std::optional<Color> light_of_ended(const Ray& ray, bool hit, const RenderSettings& settings, Operations& operations) {
  if (hit) {
    ++(ray.kind == RayKind::shadow    ? operations.shadow_blocked
       : ray.kind == RayKind::primary ? operations.primary_hits
                                      : operations.secondary_hits);
    return std::nullopt;
  }
  return settings.light_of_miss(ray);
}

/// Renders samples of one pixel, depth first, last in first out: a hit is shaded one child at a time, each child is traced to its
/// end before the next is made, and a hit is popped for its last one, so the stack holds at most one hit per depth, with paths
/// one, for any number of lights. Lives in memory given by its owner; never allocates. Copyable as bytes. `RayCursor`: Cursor, or
/// InstanceCursor, which is longer, for a database with instances.
template <class RayCursor>
class PixelTaskWith {
 public:
  static constexpr std::uint32_t pixels_max = 1;
  using Hits = HitState;  ///< an entry of the stack

  /// `stack` has at least waiting_hits_max() entries and outlives the task.
  explicit PixelTaskWith(std::span<HitState> stack) : stack_(stack) {}

  void start(std::uint32_t pixel, const SampleRange& samples, const RenderSettings& settings, Operations& operations);
  /// Starts one pixel, through the interface of tasks for several.
  void start(std::span<const std::uint32_t> pixels, std::span<const SampleStep> steps, const RenderSettings& settings,
             Operations& operations) {
    start(pixels.front(), steps.front().samples(settings.first_samples().count), settings, operations);
  }

  /// Goes on until the pixel is finished, a ray has ended (`more`), or a record is absent (see absent()). One call ends at
  /// most one ray, so it is a bounded quantum.
  template <Tracer T>
  TaskState run(T& tracer, const RenderSettings& settings, Operations& operations);

  Address absent() const { return absent_; }
  /// Whether the task needs an absent record for its ray's traversal, so that another node may continue below it, or for shading.
  bool is_tracing() const { return tracing_; }
  core::Below below(const Skips& skips) const { return core::below(ray_, cursor_, skips); }
  /// The instance that the traversal is in; nothing if it is in none.
  std::optional<ReportedInstance> instance_of_traversal() const {
    if constexpr (std::is_same_v<RayCursor, InstanceCursor>) {
      return cursor_.is_inside ? std::optional(reported_instance(cursor_)) : std::nullopt;
    }
    return std::nullopt;
  }
  /// Takes what was found below the absent record; run() goes on after it.
  void take_below(const Hit& found, const Skips& skips, Operations& operations) {
    expect(tracing_, "a traversal is what waits for what lies below");
    core::take_below(found, ray_, skips, cursor_, operations);
  }
  /// The kind of record that shading needs, or the traversal outside of meshes.
  RecordKind absent_kind() const {
    return !tracing_ ? record_kind_of(stack_[stack_size_ - 1]) : cursor_.next.is_leaf() ? RecordKind::leaf : RecordKind::bvh_node;
  }
  /// Number of rays that ended in the last run() that returned `more`.
  std::uint32_t rays_ended() const { return 1; }
  std::uint32_t pixel_count() const { return 1; }
  std::uint32_t pixel(std::uint32_t = 0) const { return pixel_; }
  const PixelSums& sums(std::uint32_t = 0) const { return sums_; }
  /// The ray in progress, or the last that ended.
  const Ray& ray() const { return ray_; }

 private:
  template <Tracer T>
  TaskState shade(T& tracer, const RenderSettings& settings, Operations& operations);
  void shoot_primary(const RenderSettings& settings, Operations& operations);
  void shoot(const Ray& ray, Operations& operations);
  void push(const HitState& hit);
  void end_ray(Traced result, const RenderSettings& settings, Operations& operations);
  bool next_sample(const RenderSettings& settings, Operations& operations);

  std::span<HitState> stack_;
  Ray ray_;
  RayCursor cursor_;
  PixelSums sums_;
  Address absent_ = no_address;
  std::uint32_t pixel_ = 0;
  std::uint32_t sample_ = 0, sample_end_ = 0;
  std::uint32_t stack_size_ = 0;
  bool tracing_ = false;
  bool shows_background_ = false;  ///< the pixel's primary rays are not traced, since they miss
};

extern template class PixelTaskWith<Cursor>;
extern template class PixelTaskWith<InstanceCursor>;

using PixelTask = PixelTaskWith<Cursor>;
using InstancePixelTask = PixelTaskWith<InstanceCursor>;

/// Calls work(task) with the type of task for the database's rays.
template <class Work>
void with_pixel_task(const DatabaseHeader& header, std::span<HitState> stack, const Work& work) {
  if (header.has_instances != 0) {
    InstancePixelTask task(stack);
    work(task);
  } else {
    PixelTask task(stack);
    work(task);
  }
}

template <class RayCursor>
template <Tracer T>
TaskState PixelTaskWith<RayCursor>::run(T& tracer, const RenderSettings& settings, Operations& operations) {
  if (!tracing_) {
    const TaskState shaded = shade(tracer, settings, operations);
    if (shaded != TaskState::more) {
      return shaded;
    }
  }
  const Traced result = shows_background_ ? Traced::miss : tracer.trace(ray_, cursor_, operations);
  if (result == Traced::absent) {
    absent_ = cursor_.absent;
    return TaskState::absent;
  }
  end_ray(result, settings, operations);
  return TaskState::more;
}

/// Shades the newest hit until it yields a ray to be traced (`more`), needs an absent record, or no hit and no sample is left.
template <class RayCursor>
template <Tracer T>
TaskState PixelTaskWith<RayCursor>::shade(T& tracer, const RenderSettings& settings, Operations& operations) {
  while ((stack_size_ = waiting_count(stack_, stack_size_)) > 0) {
    HitState& state = stack_[stack_size_ - 1];
    const Address address = record_needed(state, settings.header);
    const std::byte* record = address == no_address ? nullptr : tracer.find(address);
    if (address != no_address && record == nullptr) {
      absent_ = address;
      return TaskState::absent;
    }
    const Shader shader(settings.header, settings.shade, settings.skips, operations, &settings.camera);
    const bool was_known = state.has_surface();
    Ray child;
    const bool has_child = shader.step(state, record, child);
    if (shader.hits_glow() && !was_known && state.has_surface()) {
      deposit(sums_, state.ray, shader.glow(state), settings, operations);
    }
    if (has_child) {
      shoot(child, operations);
      return TaskState::more;
    }
  }
  return next_sample(settings, operations) ? TaskState::more : TaskState::finished;
}

}  // namespace dmpc::core
