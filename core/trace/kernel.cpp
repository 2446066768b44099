// The only file with SIMD, for AVX2 and up: below, Highway's MulAdd is not fused, so older processors take the scalar twin.
#include "core/trace/kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/vector_width.h"
#include "core/trace/instruction_set.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4

BvhChild children(const BoxRay& ray, const BvhNode& bvh_node, float t_low, float t_high, bool in_order, MetChildren& waiting) {
  return meet_children_scalar(ray, bvh_node, t_low, t_high, in_order, waiting);
}

std::uint32_t triangles(const ShearedRay& ray, const TriangleRows& leaf, std::uint32_t ignored, float t_most, float* times) {
  return hit_triangles_scalar(ray, leaf, ignored, t_most, times);
}

#else

using Tag = hn::CappedTag<float, leaf_lanes>;
using Vector = hn::Vec<Tag>;
static_assert(hn::MaxLanes(Tag()) == leaf_lanes && leaf_lanes == bvh_children_max);

template <class Mask>
HWY_INLINE std::uint32_t bits_of(const Mask& mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), mask, bits);
  return bits[0];
}

HWY_INLINE Vector floats(const std::array<std::uint8_t, 8>& row) {
  const hn::Rebind<std::int32_t, Tag> integers;
  const hn::Rebind<std::uint8_t, Tag> bytes;
  return hn::ConvertTo(Tag(), hn::PromoteTo(integers, hn::LoadU(bytes, row.data())));
}

/// Takes one of at least two children that were hit; the others wait.
HWY_INLINE BvhChild take_one(std::uint32_t met, const BvhNode& bvh_node, const float* t_enter, bool in_order,
                             MetChildren& waiting) {
  const auto next = [&] {
    const auto place = static_cast<std::size_t>(std::countr_zero(met));
    met &= met - 1;
    return place;
  };
  const std::size_t first = next(), second = next();
  if (met == 0) {
    const bool is_nearer = in_order && t_enter[first] < t_enter[second];
    const std::size_t taken = is_nearer ? first : second, other = is_nearer ? second : first;
    waiting.add(bvh_node.child[other], t_enter[other], waiting.count);
    waiting.t_taken = t_enter[taken];
    return bvh_node.child[taken];
  }
  const std::uint32_t start = waiting.count;
  const auto add = [&](std::size_t place) {
    waiting.add(bvh_node.child[place], t_enter[place], in_order ? start : waiting.count);
  };
  add(first);
  add(second);
  while (met != 0) {
    add(next());
  }
  return waiting.take();
}

BvhChild children(const BoxRay& ray, const BvhNode& bvh_node, float t_low, float t_high, bool in_order, MetChildren& waiting) {
  const Tag tag;
  Vector enter = hn::Set(tag, t_low), leave = hn::Set(tag, t_high);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto reciprocal = hn::Set(tag, ray.reciprocal[axis]);
    const auto slope = hn::Mul(hn::Set(tag, bvh_node.unit), reciprocal);
    const auto offset = hn::Mul(hn::Sub(hn::Set(tag, bvh_node.origin[axis]), hn::Set(tag, ray.origin[axis])), reciprocal);
    enter = hn::Max(enter, hn::MulAdd(floats(bvh_node.bounds[ray.near_row[axis]]), slope, offset));
    leave = hn::Min(leave, hn::MulAdd(floats(bvh_node.bounds[ray.far_row[axis]]), slope, offset));
  }
  const std::uint32_t met = bits_of(hn::Le(enter, leave)) & ((1U << bvh_node.child_count) - 1U);
  if (met == 0) {
    return BvhChild::none();
  }
  float t_enter[bvh_children_max];
  hn::StoreU(enter, tag, t_enter);
  if ((met & (met - 1)) == 0) {
    const auto only = static_cast<std::size_t>(std::countr_zero(met));
    waiting.t_taken = t_enter[only];
    return bvh_node.child[only];
  }
  return take_one(met, bvh_node, t_enter, in_order, waiting);
}

struct Vertices {
  Vector x, y, z;
};

HWY_INLINE Vertices shear(const ShearedRay& ray, const float* vertex, std::size_t stride) {
  const Tag tag;
  const auto relative = [&](std::uint32_t axis) {
    return hn::Sub(hn::LoadU(tag, vertex + axis * stride), hn::Set(tag, ray.origin[axis]));
  };
  const Vector z = relative(ray.axis_z);
  return {hn::NegMulAdd(hn::Set(tag, ray.shear_x), z, relative(ray.axis_x)),
          hn::NegMulAdd(hn::Set(tag, ray.shear_y), z, relative(ray.axis_y)), z};
}

HWY_INLINE Vector edge(const Vertices& a, const Vertices& b) { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)); }

/// Those of the triangles in `asked` that the ray passes for which floats may be wrong.
HWY_INLINE hn::Mask<Tag> within_rounding(const ShearedRay& ray, const Vertices& a, const Vertices& b, const Vertices& c,
                                         const Vector& margin, hn::Mask<Tag> asked) {
  const Tag tag;
  const auto across = [](const Vertices& v) { return hn::Max(hn::Abs(v.x), hn::Abs(v.y)); };
  const Vector widest = hn::Max(hn::Max(across(a), across(b)), across(c));
  const Vector deepest = hn::Max(hn::Max(hn::Abs(a.z), hn::Abs(b.z)), hn::Abs(c.z));
  const Vector rounding = hn::Mul(hn::Set(tag, edge_rounding), hn::Max(widest, deepest));
  const Vector bound = hn::Mul(hn::Add(rounding, hn::Set(tag, rest_weight * ray.rest())), widest);
  return hn::And(asked, hn::Le(margin, bound));
}

/// Those of these triangles that doubles decide.
HWY_INLINE hn::Mask<Tag> doubtful(const ShearedRay& ray, const Vertices& a, const Vertices& b, const Vertices& c, Vector least,
                                  Vector greatest, hn::Mask<Tag> outside) {
  const Tag tag;
  const auto limit = hn::Set(tag, near_edge);
  const auto is_near =
      hn::And(hn::Lt(hn::Min(hn::Min(a.z, b.z), c.z), limit), hn::Gt(hn::Max(hn::Max(a.z, b.z), c.z), hn::Neg(limit)));
  const auto asked = hn::And(outside, is_near);
  return HWY_LIKELY(hn::AllFalse(tag, asked)) ? asked : within_rounding(ray, a, b, c, hn::Min(hn::Neg(least), greatest), asked);
}

std::uint32_t triangles(const ShearedRay& ray, const TriangleRows& leaf, std::uint32_t ignored, float t_most, float* times) {
  const Tag tag;
  const hn::Rebind<std::uint32_t, Tag> id_tag;
  const std::size_t count = leaf.count;
  const float* rows = leaf.rows;
  const Vertices a = shear(ray, rows, count), b = shear(ray, rows + 3 * count, count), c = shear(ray, rows + 6 * count, count);
  const Vector u = edge(c, b), v = edge(a, c), w = edge(b, a);
  const Vector zero = hn::Zero(tag);
  const Vector least = hn::Min(hn::Min(u, v), w), greatest = hn::Max(hn::Max(u, v), w);
  const auto outside = hn::And(hn::Lt(least, zero), hn::Gt(greatest, zero));
  const auto on_edge = hn::Or(hn::Or(hn::Eq(u, zero), hn::Eq(v, zero)), hn::Eq(w, zero));
  const auto in_doubt = hn::Or(on_edge, doubtful(ray, a, b, c, least, greatest, outside));
  const auto real = hn::FirstN(tag, count);  // lanes after the row's end hold values of other rows
  if (hn::AllFalse(tag, hn::And(real, hn::Or(hn::Not(outside), in_doubt)))) {
    return 0;
  }
  const Vector determinant = hn::Add(hn::Add(u, v), w);
  const Vector weighted =
      hn::MulAdd(hn::Div(u, determinant), a.z, hn::MulAdd(hn::Div(v, determinant), b.z, hn::Mul(hn::Div(w, determinant), c.z)));
  const Vector t = hn::Mul(weighted, hn::Set(tag, ray.scale_z));
  hn::StoreU(t, tag, times);
  const auto ids = hn::LoadU(id_tag, reinterpret_cast<const std::uint32_t*>(leaf.ids()));
  const auto others = hn::AndNot(hn::RebindMask(tag, hn::Eq(ids, hn::Set(id_tag, ignored))), real);
  const auto crossed = hn::AndNot(hn::Or(outside, hn::Eq(determinant, zero)), others);
  const auto in_time = hn::And(hn::Gt(t, zero), hn::Le(t, hn::Set(tag, t_most)));
  const auto near = hn::And(crossed, hn::Lt(hn::Abs(t), hn::Set(tag, near_start)));
  std::uint32_t hits = bits_of(hn::And(crossed, in_time));
  std::uint32_t rest = bits_of(hn::Or(hn::And(in_doubt, others), near));
  for (; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
    times[lane] = intersect_triangle(ray, rows, count, lane);
    const std::uint32_t bit = times[lane] > 0.0F && times[lane] <= t_most ? 1U << lane : 0U;
    hits = (hits & ~(1U << lane)) | bit;
  }
  return hits;
}

#endif

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::core {
namespace {

std::uint32_t bit_if(bool condition, std::size_t lane) { return condition ? 1U << lane : 0U; }

}  // namespace

BoxRay::BoxRay(const Ray& ray, const Vec3d& reciprocal_direction) : origin(ray.origin), reciprocal(reciprocal_direction) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    near_row[axis] = reciprocal[axis] < 0.0F ? axis + 3 : axis;
    far_row[axis] = reciprocal[axis] < 0.0F ? axis : axis + 3;
  }
}

BvhChild meet_children_scalar(const BoxRay& ray, const BvhNode& bvh_node, float t_low, float t_high, bool in_order,
                              MetChildren& waiting) {
  const std::uint32_t first = waiting.count;
  for (std::size_t child = 0; child < bvh_node.child_count; ++child) {
    float enter = t_low, leave = t_high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float reciprocal = ray.reciprocal[axis];
      const float slope = bvh_node.unit * reciprocal, offset = (bvh_node.origin[axis] - ray.origin[axis]) * reciprocal;
      const auto plane = [&](std::size_t row) {
        return std::fma(static_cast<float>(bvh_node.bounds[row][child]), slope, offset);
      };
      enter = std::max(enter, plane(ray.near_row[axis]));
      leave = std::min(leave, plane(ray.far_row[axis]));
    }
    if (enter <= leave) {
      waiting.add(bvh_node.child[child], enter, in_order ? first : waiting.count);
    }
  }
  return waiting.count > first ? waiting.take() : BvhChild::none();
}

const BvhNodeKernel meet_children = DMPC_COMPILED_FOR(0, children);

std::uint32_t hit_triangles_scalar(const ShearedRay& ray, const TriangleRows& triangles, std::uint32_t ignored, float t_most,
                                   float* times) {
  std::uint32_t hits = 0;
  for (std::size_t lane = 0; lane < triangles.count; ++lane) {
    times[lane] = intersect_triangle(ray, triangles.rows, triangles.count, lane);
    const auto id = read<std::uint32_t>(triangles.ids() + lane * sizeof(std::uint32_t));
    hits |= bit_if(times[lane] > 0.0F && times[lane] <= t_most && id != ignored, lane);
  }
  return hits;
}

const TriangleKernel hit_triangles = DMPC_COMPILED_FOR(0, triangles);

const char* simd_name() {
  constexpr std::array<const char*, 3> names{"scalar", "AVX2", "AVX3"};
  return names[static_cast<std::size_t>(vector_width())];
}

std::uint32_t hit_shared_faces(const ShearedRay& ray, const std::byte* record, std::uint32_t ignored, float t_most,
                               float* times) {
  const auto header = read<LeafHeader>(record);
  const TriangleRows triangles{reinterpret_cast<const float*>(record + sizeof(header)), header.count};
  std::uint32_t hits = 0;
  for (std::uint32_t rest = header.shared_lanes; rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
    const FacePlane plane = header.has_plane() ? plane_of(header, record) : level_plane_of(triangles.rows, triangles.count, lane);
    const float t = intersect_shared_face(ray, depth_of(ray, plane), triangles.rows, triangles.count, lane);
    times[lane] = header.has_exact_plane() ? in_layer(t, ray, plane, header.layer()) : t;
    const auto id = read<std::uint32_t>(triangles.ids() + lane * sizeof(std::uint32_t));
    hits |= bit_if(times[lane] > 0.0F && times[lane] <= t_most && id != ignored, lane);
  }
  return hits;
}

std::uint32_t hit_curved(const Ray& ray, const CurvedRows& curved, float t_most, float* times) {
  const auto intersect = curved.kind == PrimitiveKind::sphere ? intersect_sphere : intersect_cone;
  std::uint32_t hits = 0;
  RayMask reached = 0;
  reach_curved(curved, &ray, 1, &t_most, &reached);
  for (; reached != 0; reached &= reached - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(reached));
    times[lane] = intersect(ray, curved.rows, curved.count, lane);
    hits |= bit_if(times[lane] > 0.0F && times[lane] <= t_most, lane);
  }
  return hits;
}

}  // namespace dmpc::core
#endif
