// Microfacet surfaces: their reflection by single scattering, and the sampling of directions. Normals have the distribution of T.
// S. Trowbridge and K. P. Reitz ("Average Irregularity Representation of a Rough Surface for Ray Reflection", Journal of the
// Optical Society of America 65 (5), 1975), called GGX by B. Walter and others ("Microfacet Models for Refraction through Rough
// Surfaces", EGSR 2007).
//
// `alpha` is above 0 and at most 1. Directions lead away from the surface; their cosines are with its normal.
#pragma once

#include <cmath>

#include "core/base/vec.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::core {

/// A surface with a smaller alpha is a mirror: its reflection has no density.
inline constexpr double sharpest_alpha = 1.0 / 512;

/// Fresnel reflection at this cosine is straight + (1 - straight) * this, where `straight` is the reflectance at normal
/// incidence: C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Computer Graphics Forum 13 (3), 1994.
inline double schlick_share(double cosine) {
  const double less = 1.0 - cosine, square = less * less;
  return square * square * less;
}

/// The reciprocal of the mean share of uniform light that this does not reflect: 1 - 1 / 21.
inline constexpr double over_mean_unreflected = 1.05;

/// The density of normals at this cosine with the surface's, above 0, per solid angle, normalised so that their cosines integrate
/// to 1.
double normal_density(double alpha, double cosine);

/// The share of microfacets that is neither hidden from the one direction nor shadowed from the other, with correlated heights
/// (E. Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", Journal of Computer Graphics Techniques 3
/// (2), 2014), over 4 times both cosines: times normal_density() of the half vector, and the reflectance of each microfacet, it
/// is the BRDF.
double microfacet_visibility(double alpha, double cosine, double other);

/// A normal sampled by its visibility from `out`, for a uniform pair: E. Heitz, "Sampling the GGX Distribution of Visible
/// Normals", Journal of Computer Graphics Techniques 7 (4), 2018. `out` and `normal` are of unit length, `out` is not below the
/// surface.
Vec3d visible_normal(const Vec3d& out, const Vec3d& normal, double alpha, const SamplePair& pair);

/// The density of directions into which visible normals reflect the one with cosine `out`, per solid angle; `half`: the cosine of
/// the half vector.
double reflected_density(double alpha, double out, double half);

}  // namespace dmpc::core
