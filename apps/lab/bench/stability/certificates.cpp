// R16: certificates of hits against rational arithmetic: on single triangles of all shapes, mainly slivers, hit anywhere, on
// edges and at vertices, from near and far; on spheres and cones; in a crowd, at grazing angles.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>

#include "apps/lab/bench/stability/case.h"
#include "apps/lab/bench/stability/crowd.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/targets.h"
#include "apps/lab/oracle/exact.h"
#include "core/trace/primitive.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveKind;
using core::PrimitiveValues;
using core::Ray;
using core::Vec3d;

void count_hit(const Ray& ray, const PrimitiveValues& values, float t, StabilityCounts& count) {
  const CertifiedHit hit = certified(ray, values, t);
  ++count.tried;
  if (!hit.is_decided) {
    ++count.explained;
    return;
  }
  const bool is_kernels = hit.fault == CertificateFault::hit || hit.fault == CertificateFault::edge;
  count.wrong_hits += is_kernels ? 1 : 0;
  count.unexplained += hit.fault != CertificateFault::none && !is_kernels ? 1 : 0;
  // If the exact ray misses, its t is anywhere on the plane.
  const double error_ulp = hit.is_inside ? hit.error_ulp : 0;
  count.error_milliulp = std::max(count.error_milliulp, static_cast<std::uint64_t>(std::ceil(error_ulp * 1000)));
}

double power_of_ten(Random& random, double least, double greatest) { return std::pow(10.0, random.between(least, greatest)); }

/// Lengths are from 1e-5 of the scene's extent to all of it; every second triangle is a sliver, down to 1e-8 of that wide.
PrimitiveValues any_triangle(Random& random) {
  const Vec3d a = random.in_box(0, 1), along = random.in_box(-1, 1) * power_of_ten(random, -5, 0);
  const double width = random.bits() % 2 == 0 ? power_of_ten(random, -8, 0) : 1.0;
  const Vec3d b = a + along, c = a + along * random.unit() + random.in_box(-1, 1) * (width * length(along));
  PrimitiveValues values{PrimitiveKind::triangle, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    values.value[axis] = static_cast<float>(a[axis]);
    values.value[3 + axis] = static_cast<float>(b[axis]);
    values.value[6 + axis] = static_cast<float>(c[axis]);
  }
  return values;
}

/// Returns the rests of four values, none of them negative: the bits of a usual float.
float any_rests(Random& random) { return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()) & 0x3f3f3f3fU); }

PrimitiveValues any_sphere(Random& random) {
  const core::Vec3f center(random.in_box(0, 1));
  const auto radius = static_cast<float>(power_of_ten(random, -6, 0));
  return {PrimitiveKind::sphere, {center.x, center.y, center.z, random.below(4) == 0 ? -radius : radius, any_rests(random)}};
}

PrimitiveValues any_cone(Random& random) {
  const core::Vec3f base(random.in_box(0, 1)), apex(core::Vec3d(base) + random.direction() * power_of_ten(random, -4, 0));
  const double low = power_of_ten(random, -4, 0), high = random.below(3) == 0 ? low : power_of_ten(random, -4, 0);
  const double sign = random.below(4) == 0 ? -1 : 1;
  return {PrimitiveKind::cone,
          {base.x, base.y, base.z, static_cast<float>(sign * low), apex.x, apex.y, apex.z, static_cast<float>(sign * high),
           any_rests(random), any_rests(random)}};
}

/// Returns a ray with rests, from 1e-6 to 10 of the scene's extent away.
Ray ray_onto(const Vec3d& at, Random& random) {
  Ray ray;
  ray.start_at(at + random.direction() * power_of_ten(random, -6, 1));
  ray.go_along(normalize(at - ray.full_origin()));
  return ray;
}

/// One target in three is a vertex, one in three on an edge.
Vec3d any_target(const PrimitiveValues& triangle, Random& random) {
  switch (random.below(3)) {
    case 0:
      return target_of(triangle, random.below(vertices_per_triangle));
    case 1:
      return on_edge(triangle, random.below(3), random.unit());
    default:
      return surface_point(triangle, random);
  }
}

struct Meeting {
  PrimitiveValues values;
  Ray ray;
  float t = 0;
};

Meeting triangle_met(Random& random) {
  const PrimitiveValues values = any_triangle(random);
  const Ray ray = ray_onto(any_target(values, random), random);
  return {values, ray, core::intersect_triangle(core::ShearedRay(ray), values.value.data(), 1, 0)};
}

Meeting sphere_met(Random& random) {
  const PrimitiveValues values = any_sphere(random);
  const Ray ray = ray_onto(surface_point(values, random), random);
  return {values, ray, core::intersect_sphere(ray, values.value.data(), 1, 0)};
}

Meeting cone_met(Random& random) {
  const PrimitiveValues values = any_cone(random);
  const Ray ray = ray_onto(surface_point(values, random), random);
  return {values, ray, core::intersect_cone(ray, values.value.data(), 1, 0)};
}

/// Returns as many hits as requested: a miss is drawn again.
ShootRays hits_of(const std::function<Meeting(Random&)>& meet) {
  return each_ray([meet](Random& random, std::uint64_t, KernelCounts& counts) {
    Meeting met;
    do {
      met = meet(random);
    } while (!(met.t > 0));
    count_hit(met.ray, met.values, met.t, counts[index_of(StabilityKernel::certified)]);
  });
}

ShootRays grazing_hits() {
  const auto database = std::make_shared<const core::Database>(core::build_database(mixed_scene(), {}));
  return hits_of([database](Random& random) -> Meeting {
    const Ray ray = grazing_ray(*database, random);
    const core::Hit hit = shoot(*database, ray);
    return hit.found() ? Meeting{database->primitives()[hit.primitive], ray, hit.t} : Meeting{};
  });
}

}  // namespace

StabilityCases certificate_cases(const StabilityAmount& amount) {
  constexpr std::uint64_t long_hits = 10'000'000;
  return {
      {"R16 certified triangles", "all shapes", amount.share(long_hits, 1), [] { return hits_of(triangle_met); }},
      {"R16 certified spheres", "all sizes", amount.share(long_hits, 1), [] { return hits_of(sphere_met); }},
      {"R16 certified cones", "all sizes", amount.share(long_hits, 1), [] { return hits_of(cone_met); }},
      {"R16 certified, grazing", "all kinds", amount.share(long_hits, 1), grazing_hits},
  };
}

}  // namespace dmpc::apps
