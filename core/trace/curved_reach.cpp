#include "core/trace/curved_reach.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/record/coordinate.h"
#include "core/trace/instruction_set.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/curved_reach.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
#include "core/trace/lanes.inl"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {
namespace {

using Lanes = hn::CappedTag<float, leaf_lanes>;
using Vector = hn::Vec<Lanes>;

/// Distances between ray and surface in floats are off by less than this share of their largest coordinates: 28 u for the line's
/// nearest point, of which 2 are the rests of each coordinate's rounding, and 12 u for the direction of a cone's axis, which
/// turns the normal of ray and axis by the more the less they differ, but then the point is next to the axis.
constexpr float place_rounding = 48 * 0x1p-24F, least_rounding = 2 * static_cast<float>(coordinate_step);
/// The height of a cone over its radius, unless it is flat (flat_cone_share) or odd.
constexpr float least_height = 0x1p-8F, endless = std::numeric_limits<float>::infinity();
/// For sums, squares and roots.
constexpr float more = 1 + 0x1p-20F;

HWY_INLINE Vector set(float value) { return hn::Set(Lanes(), value); }

struct Place {
  Vector x, y, z;
};
HWY_INLINE Vector product(const Place& a, const Place& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector largest(const Place& a) { return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }

/// The spheres around a leaf's primitives, and around cones the cylinders, too.
struct Bodies {
  Place middle;
  Vector reach;  ///< radius of the sphere around it, and what its own coordinates add to the error of distances
  Place axis;
  Vector width;  ///< radius of the cylinder, in the same way
};

HWY_INLINE Place place_at(const CurvedRows& curved, std::size_t row, std::size_t first) {
  const float* const from = curved.rows + row * curved.count + first;
  return {hn::LoadU(Lanes(), from), hn::LoadU(Lanes(), from + curved.count), hn::LoadU(Lanes(), from + 2 * curved.count)};
}
HWY_INLINE Vector value_at(const CurvedRows& curved, std::size_t row, std::size_t first) {
  return hn::LoadU(Lanes(), curved.rows + row * curved.count + first);
}
/// With what rounding adds for coordinates of that size.
HWY_INLINE Vector rounded_up(Vector radius, Vector size) {
  return hn::MulAdd(radius, set(more), hn::MulAdd(size, set(place_rounding), set(least_rounding)));
}

HWY_INLINE Bodies spheres(const CurvedRows& curved, std::size_t first) {
  Bodies bodies;
  bodies.middle = place_at(curved, 0, first);
  const Vector radius = hn::Abs(value_at(curved, 3, first));
  bodies.reach = rounded_up(radius, hn::Add(largest(bodies.middle), radius));
  return bodies;
}

HWY_INLINE Bodies cones(const CurvedRows& curved, std::size_t first) {
  const Lanes tag;
  const Place base = place_at(curved, 0, first), apex = place_at(curved, 4, first);
  const Vector base_radius = value_at(curved, 3, first), apex_radius = value_at(curved, 7, first);
  const hn::Rebind<std::int32_t, Lanes> integers;
  const auto is_flat = hn::RebindMask(tag, hn::Lt(hn::BitCast(integers, hn::Xor(base_radius, apex_radius)), hn::Zero(integers)));
  const auto along = [&](Vector from, Vector to) { return hn::IfThenElse(is_flat, to, hn::Sub(to, from)); };
  Bodies bodies;
  bodies.axis = {along(base.x, apex.x), along(base.y, apex.y), along(base.z, apex.z)};
  const Vector half = set(0.5F);
  bodies.middle = {hn::MulAdd(bodies.axis.x, half, base.x), hn::MulAdd(bodies.axis.y, half, base.y),
                   hn::MulAdd(bodies.axis.z, half, base.z)};
  const Vector radius = hn::Max(hn::Abs(base_radius), hn::Abs(apex_radius));
  const Vector square = product(bodies.axis, bodies.axis), height = hn::Sqrt(square);
  const Vector size = hn::Add(hn::Add(largest(base), largest(apex)), radius);
  // Of a thin one that is not stored as flat, as converters do, doubles know no better where it is.
  const Vector unknown =
      hn::IfThenElseZero(hn::AndNot(is_flat, hn::Lt(height, hn::Mul(radius, set(least_height)))), set(endless));
  bodies.reach = hn::Max(rounded_up(hn::Sqrt(hn::MulAdd(square, set(0.25F), hn::Mul(radius, radius))), size), unknown);
  bodies.width = hn::Max(rounded_up(radius, size), unknown);
  return bodies;
}

/// A ray, in all lanes.
struct Line {
  explicit HWY_INLINE Line(const Ray& ray, float most)
      : origin{set(ray.origin.x), set(ray.origin.y), set(ray.origin.z)},
        direction{set(ray.direction.x), set(ray.direction.y), set(ray.direction.z)},
        rounding(set(place_rounding * largest_component(ray.origin))),
        t_most(set(most)) {}

  Place origin, direction;
  Vector rounding, t_most;
};

/// The lanes that the ray passes for certain. What is not a number is not certain.
template <bool AreCones>
HWY_INLINE RayMask passed(const Line& ray, const Bodies& bodies) {
  const Lanes tag;
  const Place& d = ray.direction;
  const Place way{hn::Sub(ray.origin.x, bodies.middle.x), hn::Sub(ray.origin.y, bodies.middle.y),
                  hn::Sub(ray.origin.z, bodies.middle.z)};
  const Vector behind = product(way, d), reach = hn::Add(bodies.reach, ray.rounding);
  const Place nearest{hn::NegMulAdd(d.x, behind, way.x), hn::NegMulAdd(d.y, behind, way.y), hn::NegMulAdd(d.z, behind, way.z)};
  const auto is_beside = hn::Gt(product(nearest, nearest), hn::Mul(reach, reach));
  const auto is_outside = hn::Or(hn::Gt(behind, reach), hn::Gt(hn::Neg(hn::Add(behind, reach)), ray.t_most));
  const auto passes = hn::Or(is_beside, is_outside);
  if constexpr (!AreCones) {
    return bits_of(tag, passes);
  }
  const Place& axis = bodies.axis;
  const Place across{hn::MulSub(d.y, axis.z, hn::Mul(d.z, axis.y)), hn::MulSub(d.z, axis.x, hn::Mul(d.x, axis.z)),
                     hn::MulSub(d.x, axis.y, hn::Mul(d.y, axis.x))};
  const Vector off = product(nearest, across), width = hn::Add(bodies.width, ray.rounding);
  const auto passes_axis = hn::Gt(hn::Mul(off, off), hn::Mul(hn::Mul(width, width), product(across, across)));
  return bits_of(tag, hn::Or(passes, passes_axis));
}

/// Whether the direction has unit length up to rounding, as of all rays but odd ones.
HWY_INLINE bool is_usual(const Ray& ray) { return std::fabs(dot(ray.direction, ray.direction) - 1) < 0x1p-20F; }

template <bool AreCones>
HWY_INLINE RayMask reach_all(const CurvedRows& curved, const Ray* rays, RayMask asked, const float* t_most, RayMask* reached) {
  RayMask having = 0;
  for (std::size_t first = 0; first < curved.count; first += lanes_of<Lanes>()) {
    const Bodies bodies = AreCones ? cones(curved, first) : spheres(curved, first);
    const RayMask there = first_bits(std::min(curved.count - first, lanes_of<Lanes>()));
    for (RayMask rest = asked; rest != 0; rest &= rest - 1) {
      const auto ray = static_cast<std::size_t>(std::countr_zero(rest));
      const RayMask passes = is_usual(rays[ray]) ? passed<AreCones>(Line(rays[ray], t_most[ray]), bodies) : 0;
      reached[ray] = (first == 0 ? 0 : reached[ray]) | (there & ~passes) << first;
      having |= (reached[ray] != 0 ? RayMask{1} : RayMask{0}) << ray;
    }
  }
  return having;
}

RayMask reach(const CurvedRows& curved, const Ray* rays, RayMask asked, const float* t_most, RayMask* reached) {
  return curved.kind == PrimitiveKind::cone ? reach_all<true>(curved, rays, asked, t_most, reached)
                                            : reach_all<false>(curved, rays, asked, t_most, reached);
}

}  // namespace

CurvedReach reach_of_target() { return reach; }

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::core {

CurvedReach curved_reach(std::size_t rank) {
  const auto compiled = DMPC_COMPILED_FOR(rank, reach_of_target);
  return compiled != nullptr ? compiled() : nullptr;
}

const CurvedReach reach_curved = curved_reach(0);

}  // namespace dmpc::core
#endif
