// Cancellation: for far, tiny spheres and grazed cones, the error of t in units of a float's last place against long double.
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/oracle/curved.h"
#include "core/record/curved_values.h"
#include "core/trace/primitive.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveKind;
using core::PrimitiveValues;
using core::Ray;
using core::Vec3d;
using core::Vec3f;
using Long = long double;
using Vec3l = core::Vec3<Long>;

/// The roots of a quadratic about the ray's nearest point to the body's centre, where only the problem's own cancellation
/// remains. 64 bits of mantissa are 11 more than the kernels have.
struct Roots {
  Long first = 0, second = 0;
  Long doubt = 0;  ///< how far 2^-60 of the coefficients moves a root
  bool exist = false;
};

Roots roots_of(Long a, Long b, Long c, Long shift) {
  const Long discriminant = b * b - a * c, noise = 0x1p-60L * (b * b + std::fabs(a * c));
  if (!(discriminant > noise)) {
    return {.doubt = std::numeric_limits<Long>::infinity(), .exist = discriminant > -noise};
  }
  const Long root = std::sqrt(discriminant), q = -(b + std::copysign(root, b));
  const Long one = q / a, other = c / q;
  return {shift + std::min(one, other), shift + std::max(one, other), noise / (root * std::fabs(a)), true};
}

Vec3l row(const PrimitiveValues& values, std::size_t first) { return Vec3l(values.curved().vector(first)); }
Long radius_in(const PrimitiveValues& values, std::size_t row) { return Long{values.curved().value(row)}; }

Roots sphere_roots(const Ray& ray, const PrimitiveValues& sphere) {
  const Vec3l d(ray.full_direction()), from = Vec3l(ray.full_origin()) - row(sphere, 0);
  const Long a = dot(d, d), shift = -dot(from, d) / a, radius = radius_in(sphere, 3);
  const Vec3l nearest = from + d * shift;
  return roots_of(a, 0, dot(nearest, nearest) - radius * radius, shift);
}

/// Returns the roots of the whole double cone; the caller's rays meet it between its ends.
Roots cone_roots(const Ray& ray, const PrimitiveValues& cone) {
  const Vec3l base = row(cone, 0), axis = row(cone, 4) - base, d(ray.full_direction()), from = Vec3l(ray.full_origin()) - base;
  const Long squared = dot(axis, axis), shift = -dot(from, d) / dot(d, d);
  const Vec3l start = from + d * shift;
  const Long height = dot(start, axis) / squared, rate = dot(d, axis) / squared;
  const Vec3l across = start - axis * height, across_rate = d - axis * rate;
  const Long widening = radius_in(cone, 7) - radius_in(cone, 3);
  const Long radius = radius_in(cone, 3) + widening * height, radius_rate = widening * rate;
  return roots_of(dot(across_rate, across_rate) - radius_rate * radius_rate, dot(across, across_rate) - radius * radius_rate,
                  dot(across, across) - radius * radius, shift);
}

Long last_place(Long t) {
  const auto size = static_cast<float>(std::fabs(t));
  return static_cast<Long>(std::nextafter(size, std::numeric_limits<float>::infinity()) - size);
}

/// The error is relative to the nearer of the two roots: other tests check which of them counts.
void judge_distance(const Roots& roots, double t, StabilityCounts& count) {
  ++count.tried;
  if (!(t > 0)) {
    count.leaks += roots.exist && roots.doubt < 1 ? 1 : 0;
    return;
  }
  if (!roots.exist) {
    ++count.wrong_hits;
    return;
  }
  if (!(roots.doubt < last_place(roots.first))) {
    ++count.explained;  // a tangent: the reference is not accurate enough
    return;
  }
  const Long off = std::min(std::fabs(static_cast<Long>(t) - roots.first), std::fabs(static_cast<Long>(t) - roots.second));
  const Long ulps = off / last_place(roots.first);
  count.unexplained += ulps > 1 ? 1 : 0;
  count.error_milliulp = std::max(count.error_milliulp, static_cast<std::uint64_t>(std::ceil(ulps * 1000)));
}

struct Aim {
  PrimitiveValues body;
  Ray ray;
};

/// Returns a sphere of radius 1e-6 to 1e-2 at 1 to 1,000 times the scene's extent, hit anywhere, often near its silhouette.
Aim far_sphere(Random& random) {
  const Vec3f center(random.in_box(0, 1));
  const auto radius = static_cast<float>(std::pow(10.0, random.between(-6, -2)));
  const Vec3d from = Vec3d(center) + random.direction() * std::pow(10.0, random.between(0, 3));
  const double off = random.bits() % 2 == 0 ? random.unit() : 1 - std::pow(10.0, random.between(-9, -1));
  const Vec3d towards = Vec3d(center) - Vec3d(Vec3f(from)), side = normalize(cross(towards, random.direction()));
  return {{PrimitiveKind::sphere, {center.x, center.y, center.z, radius}},
          ray_through(from, Vec3d(center) + side * (double{radius} * off))};
}

/// Returns a cone or cylinder hit near its middle at 1e-1 to 1e-9 from a tangent plane, from up to 100 extents away.
Aim grazed_cone(Random& random) {
  const Vec3d base = random.in_box(0.3, 0.7), axis = random.direction() * random.between(0.1, 0.5);
  const double low = random.between(0.01, 0.1), high = random.bits() % 3 == 0 ? low : random.between(0.01, 0.1);
  const Vec3f from_base(base), apex(base + axis);
  const Vec3d radial = normalize(cross(axis, random.direction())), along = normalize(axis);
  const Vec3d on = base + axis * 0.5 + radial * ((low + high) * 0.5);
  const Vec3d around = cross(along, radial);
  const double turn = random.between(-1, 1), depth = std::pow(10.0, random.between(-9, -1));
  const Vec3d back = normalize(around + (axis + radial * (high - low)) * turn);
  return {{PrimitiveKind::cone,
           {from_base.x, from_base.y, from_base.z, static_cast<float>(low), apex.x, apex.y, apex.z, static_cast<float>(high)}},
          ray_through(on - back * std::pow(10.0, random.between(0, 2)), on - radial * (low * depth))};
}

ShootRays quadric_rays(Aim (*aim)(Random&)) {
  return each_ray([aim](Random& random, std::uint64_t, KernelCounts& counts) {
    const auto [body, ray] = aim(random);
    const bool sphere = body.kind == PrimitiveKind::sphere;
    const Roots roots = sphere ? sphere_roots(ray, body) : cone_roots(ray, body);
    const float t =
        sphere ? core::intersect_sphere(ray, body.value.data(), 1, 0) : core::intersect_cone(ray, body.value.data(), 1, 0);
    judge_distance(roots, double{t}, counts[index_of(StabilityKernel::grid)]);
  });
}

}  // namespace

StabilityCases quadric_cases(const StabilityAmount& amount) {
  return {{"quadrics far, tiny spheres", "spheres", amount.share(10'000'000, 1), [] { return quadric_rays(far_sphere); }},
          {"quadrics grazed cones", "cones", amount.share(10'000'000, 1), [] { return quadric_rays(grazed_cone); }}};
}

}  // namespace dmpc::apps
