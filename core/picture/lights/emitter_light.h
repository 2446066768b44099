// Light sampling (next-event estimation) of emitters: a point on an emitter, and the density of its direction.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/record/emitter.h"

namespace dmpc::core {

struct LightSample {
  Vec3d towards;       ///< unit direction to the point
  double distance;     ///< grid-local
  double cosine;       ///< between that direction and the emitter's normal, 0 to 1
  double density = 0;  ///< per steradian, including the probability of the emitter
};

/// A point on an emitter, for a uniform pair: uniform by area on a triangle (G. Turk, "Generating Random Points in Triangles",
/// Graphics Gems, 1990), on a sphere by direction in the cone in which it is seen from `from` (P. Shirley, C. Wang, K. Zimmerman,
/// "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15 (1), 1996). Nothing from within a sphere, or where a
/// triangle is seen edge-on.
std::optional<LightSample> aim_at(const EmitterRecord& emitter, const Vec3d& from, const SamplePair& pair);

/// The density of light sampling at a point of a triangle at this distance, per steradian, where it is density_on() by area.
double density_towards_triangle(double density_on, double distance, double cosine);
/// The density in any direction in which a sphere is seen whose middle is at this distance; 0 within it.
double density_towards_sphere(double density_on, double middle_distance, double radius);

/// The weight of light that was sampled with density `own`, if another technique samples it with density `other`: the power
/// heuristic with an exponent of 2 (E. Veach, L. J. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
/// SIGGRAPH 1995). One of them may be infinite or 0, not both. With the balance heuristic, whose exponent is 1, most of the error
/// would come from paths that happen to hit a small light.
constexpr double way_share(double own, double other) {
  const double ratio = other / own;
  return 1.0 / (1.0 + ratio * ratio);
}

/// How far before the point a shadow ray ends, so that it does not hit the emitter itself in spite of rounding.
double gap_before(const EmitterRecord& emitter, const LightSample& place);

}  // namespace dmpc::core
