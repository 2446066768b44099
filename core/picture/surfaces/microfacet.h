// Surfaces of tiny mirrors, their normals spread about the surface's: how much they reflect from one direction into another, by
// single scattering, and directions as likely as that. Their normals are distributed as T. S. Trowbridge and K. P. Reitz have it
// ("Average Irregularity Representation of a Rough Surface for Ray Reflection", Journal of the Optical Society of America 65 (5),
// 1975), called GGX by B. Walter and others ("Microfacet Models for Refraction through Rough Surfaces", EGSR 2007).
//
// `alpha` is above 0 and at most 1. Directions lead away from the surface; their cosines are with its normal.
#pragma once

#include <cmath>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::core {

/// A surface with less is a mirror: what it reflects has no density.
inline constexpr double sharpest_alpha = 1.0 / 512;

/// Of the light that falls on the tiny mirrors at this cosine, the share that they reflect is straight + (1 - straight) * this,
/// where they reflect `straight` at a right angle: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering",
/// Computer Graphics Forum 13 (3), 1994.
inline double schlick_share(double cosine) {
  const double less = 1.0 - cosine, square = less * less;
  return square * square * less;
}

/// One over what that leaves of light from everywhere: 1 - 1 / 21.
inline constexpr double over_mean_unreflected = 1.05;

/// Of normals at this cosine with the surface's, above 0, per solid angle, so that their cosines add up to 1.
double normal_density(double alpha, double cosine);

/// Which share of them is neither hidden from the one direction nor in the shadow of the other, by their heights (E. Heitz,
/// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", Journal of Computer Graphics Techniques 3 (2),
/// 2014), over 4 times both cosines: times normal_density() half-way between the two, and what each mirror reflects, it is the
/// BRDF.
double microfacet_visibility(double alpha, double cosine, double other);

/// A normal as likely as it is to be seen from `out`, for a pair that is as likely anywhere: E. Heitz, "Sampling the GGX
/// Distribution of Visible Normals", Journal of Computer Graphics Techniques 7 (4), 2018. Both are of unit length, `out` is not
/// below the surface, whose normal is `normal`.
Vec3d visible_normal(const Vec3d& out, const Vec3d& normal, double alpha, const SamplePair& pair);

/// Of directions into which such normals reflect the one whose cosine is `out`, per solid angle; `half`: the cosine of the
/// normal, which is half-way between the two.
double reflected_density(double alpha, double out, double half);

}  // namespace dmpc::core
