#include "apps/lab/oracle/accurate/emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/lab/oracle/accurate/ray_log.h"
#include "core/base/expect.h"
#include "core/picture/emitter_light.h"
#include "core/picture/sample_pair.h"
#include "core/record/emitter.h"
#include "core/record/records.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

/// As the product has it: nearer to a sphere paths alone find it.
constexpr double nearest = 1 + 1e-4;

double strength_of(const Vec3d& light) { return light.x + light.y + light.z; }

/// 1 - the cosine of the half angle in which a sphere is seen.
double cone_share(double radius, double distance) {
  const double square = radius / distance * (radius / distance);
  return square / (1 + std::sqrt(1 - square));
}

std::optional<AccurateAim> aim_at_sphere(const AccurateBody& body, double chance, const Vec3d& from,
                                         const core::SamplePair& pair) {
  const Vec3d way = body.place[0] - from;
  const double distance = length(way), radius = body.radius[0];
  if (distance <= radius * nearest) {
    return std::nullopt;
  }
  const double share = cone_share(radius, distance);
  const core::DiscPlace at = core::on_disc(pair);
  const double off = at.square * share, along = 1 - off, across = std::sqrt(share * (2 - off));
  const Vec3d towards = core::about_axis(way * (1 / distance), at.x * across, at.y * across, along);
  const double near_middle = dot(way, towards);
  const Vec3d aside = way - towards * near_middle;
  const double before = std::sqrt(std::max(0.0, radius * radius - dot(aside, aside)));
  const Vec3d place = from + towards * (near_middle - before);
  return AccurateAim{place, (place - body.place[0]) * (1 / radius), chance / (2 * std::numbers::pi * share)};
}

std::optional<AccurateAim> aim_at_triangle(const AccurateBody& body, double chance, const Vec3d& from,
                                           const core::SamplePair& pair) {
  const Vec3d edge1 = body.place[1] - body.place[0], edge2 = body.place[2] - body.place[0], normal = cross(edge1, edge2);
  const double first = std::sqrt(pair.x), area = length(normal) / 2;
  const Vec3d place = body.place[0] * (1 - first) + body.place[1] * (first * (1 - pair.y)) + body.place[2] * (first * pair.y);
  const Vec3d way = place - from;
  const double distance = length(way), cosine = std::fabs(dot(way, normal)) / (distance * 2 * area);
  return cosine > 0 ? std::optional(AccurateAim{place, normal * (1 / (2 * area)), chance * distance * distance / (area * cosine)})
                    : std::nullopt;
}

}  // namespace

void aim_as_product(AccurateScene& scene, const core::Database& database) {
  const core::DatabaseHeader& header = database.header();
  const core::LocalRecords records(database.bytes());
  const std::vector<std::uint32_t> bodies = bodies_of_primitives(scene, database);
  for (std::uint32_t i = 0; i < header.emitter_count; ++i) {
    const auto record = core::read<core::EmitterRecord>(records.find(core::emitter_address(header, i)));
    const std::uint32_t body = bodies[record.primitive];
    core::expect(body != core::no_primitive, "what the product aims at has a body");
    scene.emitters.push_back({body, double{record.chance}});
    scene.bodies[body].is_aimed_at = true;
    scene.choices.push_back(core::read<core::EmitterChoice>(records.find(core::choice_address(header, i))));
  }
  scene.emitter_density = double{header.emitter_density} * header.frame.scale * header.frame.scale;
}

std::optional<AccurateTarget> aim_from(const AccurateScene& scene, const Vec3d& from, const core::SamplePair& place,
                                       const core::SamplePair& digits) {
  const auto count = static_cast<std::uint32_t>(scene.emitters.size());
  core::DrawnEmitter drawn = core::choice_of(count > 1 ? place.x + digits.x * 0x1p-32 : place.x, count);
  if (count > 1) {
    drawn = core::drawn_by(scene.choices[drawn.index], drawn);
  }
  const AccurateEmitter& emitter = scene.emitters[drawn.index];
  const AccurateBody& body = scene.bodies[emitter.body];
  const core::SamplePair pair{double{drawn.place}, place.y};
  const auto aim = body.kind == core::PrimitiveKind::sphere ? aim_at_sphere(body, emitter.chance, from, pair)
                                                            : aim_at_triangle(body, emitter.chance, from, pair);
  return aim ? std::optional(AccurateTarget{emitter.body, *aim}) : std::nullopt;
}

double aimed_density(const AccurateScene& scene, const AccurateBody& body, const Vec3d& from, const Vec3d& place,
                     const Vec3d& normal) {
  const double by_area = scene.emitter_density * strength_of(scene.materials[body.material].emission);
  if (body.kind == core::PrimitiveKind::sphere) {
    const double distance = length(body.place[0] - from), radius = body.radius[0];
    return distance <= radius * nearest
               ? 0
               : by_area * 4 * std::numbers::pi * radius * radius / (2 * std::numbers::pi * cone_share(radius, distance));
  }
  const Vec3d way = place - from;
  const double distance = length(way);
  return by_area * distance * distance * distance / std::fabs(dot(way, normal));
}

}  // namespace dmpc::apps
