// The only file with SIMD. Targets from AVX2 up: below, Highway's MulAdd is not fused, so older processors take the scalar twin.
#include "core/kernel.h"

#include <bit>

#include "core/mutation.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernel.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4

void triangles(const ShearedRay& ray, const float* rows, std::size_t count, float* times) {
  triangles_scalar(ray, rows, count, times);
}

#else

using Tag = hn::CappedTag<float, block_lanes>;
using Vector = hn::Vec<Tag>;

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

HWY_INLINE Vector edge(const Vertices& a, const Vertices& b) {
  if constexpr (mutation == Mutation::contracted_edges) {
    return hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
  }
  return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
}

void triangles(const ShearedRay& ray, const float* rows, std::size_t count, float* times) {
  const Tag tag;
  static_assert(hn::MaxLanes(Tag()) == block_lanes);
  const Vertices a = shear(ray, rows, count), b = shear(ray, rows + 3 * count, count), c = shear(ray, rows + 6 * count, count);
  const Vector u = edge(c, b), v = edge(a, c), w = edge(b, a);
  const Vector zero = hn::Zero(tag);
  const auto real = hn::FirstN(tag, count);  // lanes behind the row's end hold other rows' values
  const auto on_edge = hn::And(real, hn::Or(hn::Or(hn::Eq(u, zero), hn::Eq(v, zero)), hn::Eq(w, zero)));
  const auto negative = hn::Or(hn::Or(hn::Lt(u, zero), hn::Lt(v, zero)), hn::Lt(w, zero));
  const auto positive = hn::Or(hn::Or(hn::Gt(u, zero), hn::Gt(v, zero)), hn::Gt(w, zero));
  const auto outside = hn::And(negative, positive);
  const Vector determinant = hn::Add(hn::Add(u, v), w);
  const auto hit = hn::And(real, hn::Not(hn::Or(outside, hn::Eq(determinant, zero))));
  if (hn::AllFalse(tag, hn::Or(hit, on_edge))) {
    hn::StoreU(hn::Set(tag, missed), tag, times);
    return;
  }
  const Vector weighted =
      hn::MulAdd(hn::Div(u, determinant), a.z, hn::MulAdd(hn::Div(v, determinant), b.z, hn::Mul(hn::Div(w, determinant), c.z)));
  const Vector t = hn::IfThenElse(hit, hn::Mul(weighted, hn::Set(tag, ray.scale_z)), hn::Set(tag, missed));
  hn::StoreU(t, tag, times);
  const auto near = hn::And(hit, hn::Lt(hn::Abs(t), hn::Set(tag, near_start)));
  const auto in_doubt = hn::Or(on_edge, near);
  if (!hn::AllFalse(tag, in_doubt)) [[unlikely]] {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, in_doubt, bits);
    for (std::uint32_t rest = bits[0]; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
      times[lane] = intersect_triangle(ray, rows, count, lane);
    }
  }
}

#endif

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::core {
HWY_EXPORT(triangles);

void triangles_scalar(const ShearedRay& ray, const float* rows, std::size_t count, float* times) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    times[lane] = intersect_triangle(ray, rows, count, lane);
  }
}

void triangles_simd(const ShearedRay& ray, const float* rows, std::size_t count, float* times) {
  HWY_DYNAMIC_DISPATCH(triangles)(ray, rows, count, times);
}

const char* simd_name() {
  const auto targets = hwy::SupportedTargets();
  return (targets & (HWY_AVX3 | HWY_AVX3_DL)) != 0 ? "AVX3" : (targets & HWY_AVX2) != 0 ? "AVX2" : "scalar";
}

namespace {

void intersect_lanes(const Ray& ray, const ShearedRay& sheared, PrimitiveKind kind, const float* rows, std::size_t count,
                     float* times) {
  switch (kind) {
    case PrimitiveKind::triangle:
      triangles_simd(sheared, rows, count, times);
      return;
    case PrimitiveKind::sphere:
      for (std::size_t lane = 0; lane < count; ++lane) {
        times[lane] = intersect_sphere(ray, rows, count, lane);
      }
      return;
    case PrimitiveKind::cone:
      for (std::size_t lane = 0; lane < count; ++lane) {
        times[lane] = intersect_cone(ray, rows, count, lane);
      }
      return;
  }
}

}  // namespace

void test_block(const Ray& ray, const ShearedRay& sheared, const std::byte* record, Address block, Hit& best,
                Operations& operations) {
  const auto header = read<BlockHeader>(record);
  const std::size_t count = header.count;
  const auto* rows = reinterpret_cast<const float*>(record + sizeof(BlockHeader));
  const auto* ids = reinterpret_cast<const std::uint32_t*>(rows + value_count(header.kind) * count);
  float times[block_lanes];
  intersect_lanes(ray, sheared, header.kind, rows, count, times);
  operations.primitive_tests[static_cast<std::size_t>(header.kind)] += count;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const float t = times[lane];
    if (t > 0.0F && t < ray.t_max && replaces(t, ids[lane], best) && ids[lane] != ray.ignored_primitive) {
      best = {t, ids[lane], block, static_cast<std::uint32_t>(lane)};
    }
  }
}

}  // namespace dmpc::core
#endif
