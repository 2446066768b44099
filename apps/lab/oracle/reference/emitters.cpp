#include "apps/lab/oracle/reference/emitters.h"

#include <cmath>

#include "apps/lab/oracle/reference/ray_log.h"
#include "core/base/expect.h"
#include "core/picture/lights/choosing.h"
#include "core/record/choice_node.h"
#include "core/record/emitter.h"
#include "core/record/records.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

double strength_of(const Vec3d& light) { return light.x + light.y + light.z; }

}  // namespace

void aim_as_product(ReferenceScene& scene, const core::Database& database) {
  const core::DatabaseHeader& header = database.header();
  const core::LocalRecords records(database.bytes());
  const std::vector<std::uint32_t> bodies = bodies_of_primitives(scene, database);
  for (std::uint32_t i = 0; i < header.emitter_count; ++i) {
    const auto record = core::read<core::EmitterRecord>(records.find(core::emitter_address(header, i)));
    const std::uint32_t body = bodies[record.primitive];
    core::expect(body != core::no_primitive, "what the product aims at has a body");
    scene.emitters.push_back({body, double{record.chance}});
    scene.bodies[body].is_light_sampled = true;
  }
  for (std::uint32_t i = 0; i < core::choice_node_count(header.emitter_count); ++i) {
    scene.choices.push_back(core::read<core::ChoiceNode>(records.find(core::choice_address(header, i))));
  }
  scene.emitter_density = double{header.emitter_density} * header.frame.scale * header.frame.scale;
}

std::optional<ReferenceTarget> aim_from(const ReferenceScene& scene, const Vec3d& from, const core::SamplePair& place,
                                        const core::SamplePair& digits) {
  const auto count = static_cast<std::uint32_t>(scene.emitters.size());
  const core::DrawnEmitter drawn = core::drawn_from(scene.choices, count, place.x, digits.x);
  const ReferenceEmitter& emitter = scene.emitters[drawn.index];
  const ReferenceBody& body = scene.bodies[emitter.body];
  const auto& [a, b, c] = body.place;
  const bool is_sphere = body.kind == core::PrimitiveKind::sphere;
  const auto aim = is_sphere ? aim_at_sphere(a, body.radius[0], emitter.chance, from, {double{drawn.place}, place.y})
                             : aim_at_triangle(body.place, emitter.chance, from, double{drawn.place}, place.y);
  return aim ? std::optional(
                   ReferenceTarget{*aim, emitter.body, normalize(is_sphere ? from + aim->way - a : cross(b - a, c - a))})
             : std::nullopt;
}

double light_sampling_density(const ReferenceScene& scene, const ReferenceBody& body, const Vec3d& from, const Vec3d& place,
                              const Vec3d& normal) {
  const double by_area = scene.emitter_density * strength_of(scene.materials[body.material].emission);
  if (body.kind == core::PrimitiveKind::sphere) {
    return density_of_sphere(by_area, body.place[0] - from, body.radius[0]);
  }
  const Vec3d way = place - from;
  const double distance = length(way);
  return by_area * distance * distance * distance / std::fabs(dot(way, normal));
}

}  // namespace dmpc::apps
