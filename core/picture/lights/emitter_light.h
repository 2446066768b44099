// A place on an emitter that a hit aims at, and how densely hits aim where a ray goes.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/record/emitter.h"

namespace dmpc::core {

/// An emitter, or its choice, and where on it.
struct DrawnEmitter {
  std::uint32_t index = 0;
  float place = 0;  ///< below 1: as likely anywhere, whichever was drawn
};

/// The place in a table of `count` choices, 1 or more, that a number from 0 to less than 1 comes to; of one it is the emitter.
/// Numbers that are evenly spread are so, too, on their ways through each place, and on each emitter that they draw: so samples
/// are not only well shared out to emitters, but lie well on each.
DrawnEmitter choice_of(double number, std::uint32_t count);
/// What is drawn where a number has come to this choice.
DrawnEmitter drawn_by(const EmitterChoice& choice, const DrawnEmitter& at);

struct LightSample {
  Vec3d towards;       ///< it, of unit length
  double distance;     ///< grid-local
  double cosine;       ///< between the way there and the emitter's normal, 0 to 1
  double density = 0;  ///< of this direction, per steradian, the emitter's chance included
};

/// A place on an emitter, for a pair that is as likely anywhere: of a triangle any is as likely by area (G. Turk, "Generating
/// Random Points in Triangles", Graphics Gems, 1990), of a sphere any direction in the cone in which it is seen from `from` (P.
/// Shirley, C. Wang, K. Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations", ACM TOG 15 (1), 1996). Nothing from
/// within a sphere, or where a triangle is seen edge-on.
std::optional<LightSample> aim_at(const EmitterRecord& emitter, const Vec3d& from, const SamplePair& pair);

/// How densely hits aim at a place of a triangle at this distance, per steradian, where it is density_on() by area.
double density_towards_triangle(double density_on, double distance, double cosine);
/// At any direction in which a sphere is seen whose middle is so far away; 0 within it.
double density_towards_sphere(double density_on, double middle_distance, double radius);

/// What counts of light that came by a way of density `own`, if another might have brought it with density `other`: the power
/// heuristic with an exponent of 2 (E. Veach, L. J. Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
/// SIGGRAPH 1995). Either may be infinite or 0, not both alike. By the balance heuristic, whose exponent is 1, paths that
/// happen to meet a small light would count so much that they make most of the error.
constexpr double way_share(double own, double other) {
  const double ratio = other / own;
  return 1.0 / (1.0 + ratio * ratio);
}

/// How far before the place a shadow ray ends, so that the emitter itself is not met, however rounding moves it.
double gap_before(const EmitterRecord& emitter, const LightSample& place);

}  // namespace dmpc::core
