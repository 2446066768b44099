#include "core/picture/lights/emitter_light.h"

#include <algorithm>
#include <cmath>

#include "core/picture/sampling/sample_pair.h"

namespace dmpc::core {
namespace {

constexpr double two_pi = 6.28318530717958648;
/// A sphere is not sampled from a point nearer to its surface than this share of its radius: half of all directions hit it there,
/// so paths find it by themselves.
constexpr double clearance_share = 1e-4;
/// A shadow ray ends before the emitter by at least this share of its length, and so far that the rounding of coordinates, a few
/// units in the last place of a float, cannot take it there: farther the more it grazes, down to this cosine.
constexpr double gap_share = 1e-6, rounding_share = 0x1p-21, grazing_cosine = 0x1p-10;

/// The cosine between axis and side of the cone that a sphere subtends, `distance` being its centre's. Positive outside.
double rim_cosine(double distance, double radius) {
  const double sine = radius / distance;
  return std::sqrt(std::max(0.0, 1.0 - sine * sine));
}

bool is_within(double distance, double radius) { return !(distance > radius * (1.0 + clearance_share)); }

std::optional<LightSample> aim_at_triangle(const EmitterRecord& emitter, const Vec3d& from, const SamplePair& pair) {
  const Vec3d corner(emitter.corner[0]), edge1 = Vec3d(emitter.corner[1]) - corner, edge2 = Vec3d(emitter.corner[2]) - corner;
  const double across = std::sqrt(pair.x);
  const Vec3d way = corner + edge1 * (across * (1.0 - pair.y)) + edge2 * (across * pair.y) - from;
  const Vec3d normal = cross(edge1, edge2);
  const double distance = length(way), twice_area = length(normal), slant = std::fabs(dot(way, normal));
  if (!(slant > 0.0)) {
    return std::nullopt;
  }
  const double cosine = slant / (distance * twice_area);
  return LightSample{way * (1.0 / distance), distance, cosine,
                     double{emitter.chance} * 2.0 * distance * distance / (twice_area * cosine)};
}

/// Maps a point of the unit disc to the cone: its square is proportional to one minus the cosine, which measures the share of the
/// cone nearer to the axis.
std::optional<LightSample> aim_at_sphere(const EmitterRecord& emitter, const Vec3d& from, const SamplePair& pair) {
  const Vec3d way = emitter.center() - from;
  const double distance = length(way), radius = emitter.radius();
  if (is_within(distance, radius)) {
    return std::nullopt;
  }
  const double sine = radius / distance, less = sine * sine / (1.0 + rim_cosine(distance, radius));  // 1 - that cosine
  const DiscPlace place = on_disc(pair);
  const double off = place.square * less, stretch = std::sqrt(less * (2.0 - off));
  const Vec3d towards = normalize(about_axis(way * (1.0 / distance), place.x * stretch, place.y * stretch, 1.0 - off));
  const double square_sine = off * (2.0 - off), cosine = std::sqrt(std::max(0.0, 1.0 - square_sine / (sine * sine)));
  return LightSample{towards, distance * (1.0 - off) - radius * cosine, cosine, double{emitter.chance} / (two_pi * less)};
}

}  // namespace

std::optional<LightSample> aim_at(const EmitterRecord& emitter, const Vec3d& from, const SamplePair& pair) {
  return emitter.kind == PrimitiveKind::sphere ? aim_at_sphere(emitter, from, pair) : aim_at_triangle(emitter, from, pair);
}

double density_towards_triangle(double density_on, double distance, double cosine) {
  return density_on * distance * distance / cosine;
}

/// The sphere's area times the density by area, over the solid angle of its cone.
double density_towards_sphere(double density_on, double middle_distance, double radius) {
  return is_within(middle_distance, radius)
             ? 0.0
             : density_on * 2.0 * middle_distance * middle_distance * (1.0 + rim_cosine(middle_distance, radius));
}

double gap_before(const EmitterRecord& emitter, const LightSample& place) {
  const double size = std::max({largest_component(Vec3d(emitter.corner[0])), largest_component(Vec3d(emitter.corner[1])),
                                largest_component(Vec3d(emitter.corner[2]))});
  const double by_rounding = rounding_share * (place.distance + size) / std::max(place.cosine, grazing_cosine);
  return std::min(std::max(gap_share * place.distance, by_rounding), 0.5 * place.distance);
}

}  // namespace dmpc::core
