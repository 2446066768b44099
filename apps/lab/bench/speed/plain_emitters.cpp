#include "apps/lab/bench/speed/plain_emitters.h"

#include <cmath>

#include "core/picture/lights/choosing.h"
#include "core/picture/lights/emitter_light.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

using core::Vec3f;

std::optional<PlainAim> plain_aim(const PlainStage& stage, const Vec3f& from, const core::SamplePair& emitter,
                                  const core::SamplePair& place) {
  const auto count = static_cast<std::uint32_t>(stage.emitters().size());
  const core::DrawnEmitter drawn = core::drawn_from(stage.choices(), count, place.x, emitter.x);
  const core::EmitterRecord& record = stage.emitters()[drawn.index];
  const auto aim = record.kind == core::PrimitiveKind::sphere
                       ? aim_at_sphere(record.corner[0], record.corner[1].x, record.chance, from, {double{drawn.place}, place.y})
                       : aim_at_triangle(record.corner, record.chance, from, drawn.place, static_cast<float>(place.y));
  return aim ? std::optional(PlainAim{*aim, record.radiance}) : std::nullopt;
}

float plain_bsdf_density(const PlainStage& stage, const PlainSurface& surface, const Vec3f& from, const Vec3f& direction,
                         const core::Color& radiance) {
  const auto density_on = static_cast<float>(core::density_on(stage.settings().header, radiance));
  const Vec3f way = surface.point - from;
  return surface.radius > 0 ? density_of_sphere(density_on, way - surface.geometric_normal * surface.radius, surface.radius)
                            : density_on * dot(way, way) / std::fabs(dot(direction, surface.geometric_normal));
}

}  // namespace dmpc::apps
