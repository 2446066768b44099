// Light sampling of the path tracers that judge pictures, in single and in double precision. Its arithmetic shares only the maps
// from random numbers to a disc with core's.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

template <class Real>
struct EmitterAim {
  core::Vec3<Real> way;      ///< to the point on the emitter
  core::Vec3<Real> towards;  ///< direction as a unit vector
  Real density;              ///< probability density of this direction, per steradian, including the emitter's probability
};

/// As in the product, a point nearer to a sphere's centre than this, in radii, does not sample the sphere.
template <class Real>
constexpr Real sphere_clearance = 1 + Real{1} / 10'000;

/// Returns 1 less the cosine between the direction to a sphere's rim and the direction to its centre.
template <class Real>
Real rim_height(Real sine) {
  return sine * sine / (1 + std::sqrt(std::max(Real{0}, 1 - sine * sine)));
}

/// Returns nothing where the triangle is seen edge-on.
template <class Real>
std::optional<EmitterAim<Real>> aim_at_triangle(const std::array<core::Vec3<Real>, 3>& corner, Real chance,
                                                const core::Vec3<Real>& from, Real x, Real y) {
  const core::Vec3<Real> edge1 = corner[1] - corner[0], edge2 = corner[2] - corner[0];
  const Real across = std::sqrt(x);
  const core::Vec3<Real> way = corner[0] + edge1 * (across * (1 - y)) + edge2 * (across * y) - from;
  const Real distance = length(way), slant = std::fabs(dot(way, cross(edge1, edge2)));  // times twice the area
  return slant > 0
             ? std::optional(EmitterAim<Real>{way, way * (1 / distance), chance * 2 * distance * distance * distance / slant})
             : std::nullopt;
}

/// Returns nothing from within or next to the sphere.
template <class Real>
std::optional<EmitterAim<Real>> aim_at_sphere(const core::Vec3<Real>& middle, Real radius, Real chance,
                                              const core::Vec3<Real>& from, const core::SamplePair& place) {
  const core::Vec3<Real> way = middle - from;
  const Real distance = length(way);
  if (!(distance > radius * sphere_clearance<Real>)) {
    return std::nullopt;
  }
  const Real sine = radius / distance, less = rim_height(sine);
  const core::DiscPlace disc = core::on_disc(place);
  const Real off = static_cast<Real>(disc.square) * less, stretch = std::sqrt(less * (2 - off));
  const core::Vec3<Real> towards(normalize(
      core::about_axis(core::Vec3d(way * (1 / distance)), disc.x * double{stretch}, disc.y * double{stretch}, double{1 - off})));
  const Real cosine = std::sqrt(std::max(Real{0}, 1 - off * (2 - off) / (sine * sine)));
  return EmitterAim<Real>{towards * (distance * (1 - off) - radius * cosine), towards,
                          chance / (2 * std::numbers::pi_v<Real> * less)};
}

/// Returns the density per steradian with which a sphere at this distance is sampled, where `by_area` is the density on its
/// surface.
template <class Real>
Real density_of_sphere(Real by_area, const core::Vec3<Real>& to_middle, Real radius) {
  const Real square = dot(to_middle, to_middle), sine = radius / std::sqrt(square);
  return sine * sphere_clearance<Real> < 1 ? by_area * 2 * square * (2 - rim_height(sine)) : 0;
}

}  // namespace dmpc::apps
