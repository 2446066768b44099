#include "apps/lab/bench/speed/plain_emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/picture/emitter_light.h"
#include "core/picture/sample_pair.h"

namespace dmpc::apps {

namespace {

using core::EmitterRecord;
using core::Vec3f;

constexpr float two_pi = 2 * std::numbers::pi_v<float>;
/// As ours: who is nearer than this to a sphere does not aim at it.
constexpr float clearance = 1 + 1e-4F;

/// One less the cosine that a sphere's rim has to the way to its middle.
float rim_height(float sine) { return sine * sine / (1 + std::sqrt(std::max(0.0F, 1 - sine * sine))); }

std::optional<PlainAim> aim_at_triangle(const EmitterRecord& emitter, const Vec3f& from, float x, float y) {
  const Vec3f edge1 = emitter.corner[1] - emitter.corner[0], edge2 = emitter.corner[2] - emitter.corner[0];
  const float across = std::sqrt(x);
  const Vec3f way = emitter.corner[0] + edge1 * (across * (1 - y)) + edge2 * (across * y) - from;
  const float distance = length(way), slant = std::fabs(dot(way, cross(edge1, edge2)));  // times twice the area
  return slant > 0 ? std::optional(PlainAim{way, way * (1 / distance), emitter.radiance,
                                            emitter.chance * 2 * distance * distance * distance / slant})
                   : std::nullopt;
}

std::optional<PlainAim> aim_at_sphere(const EmitterRecord& emitter, const Vec3f& from, const core::SamplePair& place) {
  const Vec3f way = emitter.corner[0] - from;
  const float distance = length(way), radius = emitter.corner[1].x;
  if (!(distance > radius * clearance)) {
    return std::nullopt;
  }
  const float sine = radius / distance, less = rim_height(sine);
  const core::DiscPlace disc = core::on_disc(place);
  const float off = static_cast<float>(disc.square) * less, stretch = std::sqrt(less * (2 - off));
  const Vec3f towards(normalize(
      core::about_axis(core::Vec3d(way * (1 / distance)), disc.x * double{stretch}, disc.y * double{stretch}, double{1 - off})));
  const float cosine = std::sqrt(std::max(0.0F, 1 - off * (2 - off) / (sine * sine)));
  return PlainAim{towards * (distance * (1 - off) - radius * cosine), towards, emitter.radiance,
                  emitter.chance / (two_pi * less)};
}

}  // namespace

std::optional<PlainAim> plain_aim(const PlainStage& stage, const Vec3f& from, const core::SamplePair& emitter,
                                  const core::SamplePair& place) {
  const auto count = static_cast<std::uint32_t>(stage.emitters().size());
  core::DrawnEmitter drawn = core::choice_of(place.x + (count > 1 ? emitter.x * 0x1p-32 : 0.0), count);
  if (count > 1) {
    drawn = core::drawn_by(stage.choices()[drawn.index], drawn);
  }
  const EmitterRecord& record = stage.emitters()[drawn.index];
  return record.kind == core::PrimitiveKind::sphere ? aim_at_sphere(record, from, {double{drawn.place}, place.y})
                                                    : aim_at_triangle(record, from, drawn.place, static_cast<float>(place.y));
}

float plain_density_met(const PlainStage& stage, const PlainSurface& surface, const Vec3f& from, const Vec3f& direction,
                        const core::Color& radiance) {
  const auto density_on = static_cast<float>(core::density_on(stage.settings().header, radiance));
  const Vec3f way = surface.point - from;
  if (surface.radius > 0) {
    const Vec3f middle = way - surface.geometric_normal * surface.radius;
    const float square = dot(middle, middle), sine = surface.radius / std::sqrt(square);
    return sine * clearance < 1 ? density_on * 2 * square * (2 - rim_height(sine)) : 0;
  }
  return density_on * dot(way, way) / std::fabs(dot(direction, surface.geometric_normal));
}

}  // namespace dmpc::apps
