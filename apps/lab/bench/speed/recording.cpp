#include "apps/lab/bench/speed/recording.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/picture/bundle_task.h"
#include "core/picture/shade.h"
#include "core/picture/surfaces/path_step.h"
#include "svm/work_items.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Returns a number uniform in [0, 1).
double random(std::uint64_t number, std::uint64_t dimension) {
  return static_cast<double>(core::mix(core::mix(number + 1) + dimension) >> 11U) * 0x1p-53;
}

RayClass class_of(core::RayKind kind) {
  switch (kind) {
    case core::RayKind::primary:
      return RayClass::primary;
    case core::RayKind::shadow:
      return RayClass::shadow;
    case core::RayKind::reflected:
    case core::RayKind::refracted:
    case core::RayKind::scattered:
      break;
  }
  return RayClass::secondary;
}

/// A core::BundleTracer that records its queries.
class RecordingTracer {
 public:
  RecordingTracer(const core::Database& database, std::size_t most)
      : records_(database.bytes()), header_(database.header()), grid_(records_, header_, {}), samples_(of_each_class(most)) {}

  bool trace(core::RayBundle& bundle, core::Operations& operations) {
    const bool is_ended = grid_.trace(bundle, operations);
    const core::RayKind kind = bundle.rays[0].kind;
    sample(class_of(kind)).offer(std::span(bundle.rays).first(bundle.count));
    if (kind == core::RayKind::primary) {
      sample_bounces(bundle);
    }
    return is_ended;
  }
  const std::byte* find(core::Address address) { return grid_.find(address); }

  BundleSample& sample(RayClass ray_class) { return samples_[static_cast<std::size_t>(ray_class)]; }

 private:
  using Samples = std::array<BundleSample, ray_class_count>;

  static Samples of_each_class(std::size_t most) {
    return {BundleSample(most), BundleSample(most), BundleSample(most), BundleSample(most)};
  }

  void sample_bounces(const core::RayBundle& primary) {
    std::array<core::Ray, core::bundle_rays_max> bounces;
    std::size_t count = 0;
    for (std::size_t i = 0; i < primary.count; ++i) {
      if ((primary.found >> i & 1U) != 0) {
        bounces[count++] = bounce_ray(primary.rays[i], primary.best.of(i), records_, header_, bounces_++);
      }
    }
    if (count > 0) {
      sample(RayClass::bounce).offer(std::span(bounces).first(count));
    }
  }

  core::LocalRecords records_;
  core::DatabaseHeader header_;
  core::GridTracer<core::LocalRecords> grid_;
  Samples samples_;
  std::uint64_t bounces_ = 0;
};

/// Returns the next pixels whose rays form bundles: those of a tile.
std::vector<std::uint32_t> next_tile(svm::PixelScan& scan, std::uint32_t image_width) {
  std::vector<std::uint32_t> pixels;
  do {
    pixels.push_back(scan.next(image_width));
  } while (scan.stays_in_tile());
  return pixels;
}

void render_in_bundles(RecordingTracer& tracer, const core::RenderSettings& settings, core::Operations& operations) {
  const core::SampleRange samples = settings.first_samples();
  const auto width = static_cast<std::uint32_t>(settings.camera.width());
  const auto height = static_cast<std::uint32_t>(settings.camera.height());
  std::vector<core::BundleHit> stack(static_cast<std::size_t>(settings.shade.depth_max));
  const auto task = std::make_unique<core::BundleTask>(stack);
  svm::PixelScan scan({0, 0, width, height}, svm::tile_for(samples.count, core::BundleTask::pixels_max));
  while (!scan.empty()) {
    const std::vector<std::uint32_t> pixels = next_tile(scan, width);
    task->start(pixels, std::vector(pixels.size(), core::SampleStep::first()), settings, operations);
    core::TaskState state = core::TaskState::more;
    while (state == core::TaskState::more) {
      state = task->run(tracer, settings, operations);
    }
    core::expect(state == core::TaskState::finished, "who records rays has every record");
  }
}

}  // namespace

const char* name_of(RayClass ray_class) {
  static constexpr std::array<const char*, ray_class_count> names = {"primary", "shadow", "secondary", "bounce"};
  return names[static_cast<std::size_t>(ray_class)];
}

void BundleSample::offer(std::span<const core::Ray> bundle) {
  const std::uint64_t hash = core::mix(++shot_);
  if (!is_kept(hash)) {
    return;
  }
  kept_.push_back({hash, {bundle.begin(), bundle.end()}});
  rays_buffered_ += bundle.size();
  while (rays_buffered_ > most_) {
    halve();
  }
}

void BundleSample::halve() {
  stride_ *= 2;
  std::erase_if(kept_, [this](const Numbered& numbered) { return !is_kept(numbered.hash); });
  rays_buffered_ = std::accumulate(kept_.begin(), kept_.end(), std::size_t{0},
                                   [](std::size_t sum, const Numbered& numbered) { return sum + numbered.rays.size(); });
}

BundledRays BundleSample::bundles() const {
  BundledRays bundles;
  for (const Numbered& numbered : kept_) {
    bundles.add(numbered.rays);
  }
  return bundles;
}

core::Ray bounce_ray(const core::Ray& primary, const core::Hit& hit, const core::LocalRecords& records,
                     const core::DatabaseHeader& header, std::uint64_t number) {
  core::HitState state = core::begin_shading(primary, hit);
  core::Operations unused;
  const core::ShadeOptions options;
  const core::Skips skips;
  const core::Shader shader(header, options, skips, unused);
  core::Ray bounce;
  shader.step(state, records.find(core::record_needed(state, header)), bounce);
  // A mirror that turns the ray into the drawn direction makes the child ray.
  const Vec3d normal = state.leaving ? -state.geometric_normal : state.geometric_normal;
  state.normal =
      core::normalize(core::cosine_direction({random(number, 0), random(number, 1)}, normal) - Vec3d(primary.direction));
  state.stage = core::HitState::Stage::reflected;
  state.set_gloss({});
  shader.step(state, nullptr, bounce);
  return bounce;
}

Recording record_rays(const core::Database& database, const core::RenderSettings& settings, std::size_t most) {
  RecordingTracer tracer(database, most);
  Recording recording;
  render_in_bundles(tracer, settings.with_every_ray_traced(), recording.operations);
  for (std::size_t i = 0; i < ray_class_count; ++i) {
    recording.rays[i] = tracer.sample(RayClass{static_cast<std::uint8_t>(i)}).bundles();
  }
  return recording;
}

}  // namespace dmpc::apps
