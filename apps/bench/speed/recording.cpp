#include "apps/bench/speed/recording.h"

#include <algorithm>
#include <cmath>

#include "core/base/elementary.h"
#include "core/base/sampling.h"
#include "core/picture/render.h"
#include "core/picture/shade.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// Uniform in [0, 1).
double random(std::uint64_t number, std::uint64_t dimension) {
  return static_cast<double>(core::mix(core::mix(number + 1) + dimension) >> 11U) * 0x1p-53;
}

/// A direction of unit length about `normal`, cosine-weighted: a point drawn from the disc, lifted to the hemisphere
/// (N. Malley; M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, section 13.6.3).
Vec3d direction_about(const Vec3d& normal, std::uint64_t number) {
  constexpr double full_turn = 360;
  const double share = random(number, 0), angle = full_turn * random(number, 1);
  const Vec3d aside = std::fabs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d first = core::normalize(core::cross(normal, aside)), second = core::cross(normal, first);
  const double radius = std::sqrt(share);
  return first * (radius * core::cos_degrees(angle)) + second * (radius * core::sin_degrees(angle)) +
         normal * std::sqrt(1 - share);
}

RayClass class_of(core::RayKind kind) {
  switch (kind) {
    case core::RayKind::primary:
      return RayClass::primary;
    case core::RayKind::shadow:
      return RayClass::shadow;
    case core::RayKind::reflected:
    case core::RayKind::refracted:
      break;
  }
  return RayClass::secondary;
}

/// A core::Tracer that notes what it is asked.
class RecordingTracer {
 public:
  RecordingTracer(const core::Database& database, std::size_t most)
      : records_(database.bytes()), header_(database.header()), grid_(records_, header_, {}) {
    samples_.fill(RaySample(most));
  }

  core::Traced trace(const core::Ray& ray, core::Cursor& cursor, core::Operations& operations) {
    const core::Traced result = grid_.trace(ray, cursor, operations);
    sample(class_of(ray.kind)).offer(ray);
    if (ray.kind == core::RayKind::primary && result == core::Traced::hit) {
      sample(RayClass::bounce).offer(bounce_ray(ray, cursor.best, records_, header_, bounces_++));
    }
    return result;
  }
  const std::byte* find(core::Address address) { return grid_.find(address); }

  RaySample& sample(RayClass ray_class) { return samples_[static_cast<std::size_t>(ray_class)]; }

 private:
  core::LocalRecords records_;
  core::DatabaseHeader header_;
  core::GridTracer<core::LocalRecords> grid_;
  std::array<RaySample, ray_class_count> samples_{RaySample(1), RaySample(1), RaySample(1), RaySample(1)};
  std::uint64_t bounces_ = 0;
};

}  // namespace

const char* name_of(RayClass ray_class) {
  static constexpr std::array<const char*, ray_class_count> names = {"primary", "shadow", "secondary", "bounce"};
  return names[static_cast<std::size_t>(ray_class)];
}

void RaySample::offer(const core::Ray& ray) {
  const std::uint64_t hash = core::mix(++shot_);
  if (!is_kept(hash)) {
    return;
  }
  kept_.push_back({hash, ray});
  while (kept_.size() > most_) {
    stride_ *= 2;
    std::erase_if(kept_, [this](const Numbered& numbered) { return !is_kept(numbered.hash); });
  }
}

std::vector<core::Ray> RaySample::rays() const {
  std::vector<core::Ray> rays(kept_.size());
  std::transform(kept_.begin(), kept_.end(), rays.begin(), [](const Numbered& numbered) { return numbered.ray; });
  return rays;
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
  // A mirror that turns the ray into the direction drawn makes the child that starts there.
  const Vec3d normal = state.leaving ? -state.geometric_normal : state.geometric_normal;
  state.normal = core::normalize(direction_about(normal, number) - Vec3d(primary.direction));
  state.stage = core::HitState::Stage::reflected;
  shader.step(state, nullptr, bounce);
  return bounce;
}

Recording record_rays(const core::Database& database, const core::RenderSettings& settings, std::size_t most) {
  RecordingTracer tracer(database, most);
  Recording recording;
  core::render(tracer, settings.with_every_ray_traced(), recording.operations);
  for (std::size_t i = 0; i < ray_class_count; ++i) {
    recording.rays[i] = tracer.sample(RayClass{static_cast<std::uint8_t>(i)}).rays();
  }
  return recording;
}

}  // namespace dmpc::apps
