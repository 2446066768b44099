#include "core/picture/surfaces/microfacet.h"

#include <algorithm>
#include <numbers>

#include "core/picture/sampling/sample_pair.h"

namespace dmpc::core {
namespace {

/// Twice Smith's function of a cosine, minus the cosine; equal to the cosine for a smooth surface.
double roughened(double alpha, double cosine) {
  const double square = alpha * alpha;
  return std::sqrt(square + (1.0 - square) * cosine * cosine);
}

}  // namespace

double normal_density(double alpha, double cosine) {
  const double square = alpha * alpha, spread = 1.0 - cosine * cosine * (1.0 - square);
  return square * std::numbers::inv_pi / (spread * spread);
}

double microfacet_visibility(double alpha, double cosine, double other) {
  return 0.5 / (other * roughened(alpha, cosine) + cosine * roughened(alpha, other));
}

/// In coordinates whose third axis is the normal and whose first is the part of `out` perpendicular to it. The surface's
/// ellipsoid is stretched to a hemisphere, and a point is chosen on the disc that is visible of it from `out`.
Vec3d visible_normal(const Vec3d& out, const Vec3d& normal, double alpha, const SamplePair& pair) {
  const double height = std::max(dot(out, normal), 0.0);
  const Vec3d beside = out - normal * height;
  const double slant = length(beside);
  const Vec3d first = slant > 0.0 ? beside * (1.0 / slant) : about_axis(normal, 1.0, 0.0, 0.0);
  const double size = std::sqrt(alpha * alpha * slant * slant + height * height);
  const double sine = alpha * slant / size, cosine = height / size;
  const DiscPlace place = on_disc(pair);
  const double edge = std::sqrt(std::max(0.0, 1.0 - place.x * place.x)), lower = 0.5 * (1.0 + cosine);
  const double up = (1.0 - lower) * edge + lower * place.y;
  const double ahead = std::sqrt(std::max(0.0, 1.0 - place.x * place.x - up * up));
  const double x = alpha * (ahead * sine - up * cosine), y = alpha * place.x, z = std::max(0.0, ahead * cosine + up * sine);
  return normalize(first * x + cross(normal, first) * y + normal * z);
}

/// The density of visible normals, (visible area) cosine to `out` / out cosine, over 4 times the cosine with `out`, the Jacobian
/// of the reflection.
double reflected_density(double alpha, double out, double half) {
  return normal_density(alpha, half) / (2.0 * (out + roughened(alpha, out)));
}

}  // namespace dmpc::core
