#include "apps/lab/bench/speed/packet_shading.h"

#include <algorithm>

#include "apps/lab/bench/speed/plain_stage.h"
#include "core/trace/instruction_set.h"

// clang-format off
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "apps/lab/bench/speed/packet_shading.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each target
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace dmpc::apps::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, packet_rays>;
using Integers = hn::Rebind<std::int32_t, Floats>;
using Some = hn::Vec<Floats>;
using Those = hn::Mask<Floats>;
constexpr Floats floats;
constexpr Integers integers;

struct Vectors {
  Some x, y, z;
};

HWY_INLINE Some take(const FloatRow& row, std::size_t i) { return hn::Load(floats, row.data() + i); }
HWY_INLINE Vectors take(const VectorRow& row, std::size_t i) { return {take(row.x, i), take(row.y, i), take(row.z, i)}; }
HWY_INLINE Those those(const IntRow& row, std::size_t i) {
  return hn::RebindMask(floats, hn::Lt(hn::Load(integers, row.data() + i), hn::Zero(integers)));
}
HWY_INLINE void put(Those mask, IntRow& row, std::size_t i) {
  hn::Store(hn::VecFromMask(integers, hn::RebindMask(integers, mask)), integers, row.data() + i);
}
HWY_INLINE void put(Some values, FloatRow& row, std::size_t i) { hn::Store(values, floats, row.data() + i); }
HWY_INLINE void put(const Vectors& values, VectorRow& row, std::size_t i) {
  put(values.x, row.x, i);
  put(values.y, row.y, i);
  put(values.z, row.z, i);
}

HWY_INLINE Some number(float value) { return hn::Set(floats, value); }
HWY_INLINE Vectors plus(const Vectors& a, const Vectors& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE Vectors minus(const Vectors& a, const Vectors& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE Vectors times(const Vectors& a, Some b) { return {hn::Mul(a.x, b), hn::Mul(a.y, b), hn::Mul(a.z, b)}; }
HWY_INLINE Vectors times(const Vectors& a, const Vectors& b) { return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)}; }
/// a + b c
HWY_INLINE Vectors plus_times(const Vectors& a, const Vectors& b, Some c) {
  return {hn::MulAdd(b.x, c, a.x), hn::MulAdd(b.y, c, a.y), hn::MulAdd(b.z, c, a.z)};
}
HWY_INLINE Some product(const Vectors& a, const Vectors& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Some over_length(const Vectors& a) { return hn::Div(number(1), hn::Sqrt(product(a, a))); }
HWY_INLINE Vectors of_unit_length(const Vectors& a) { return times(a, over_length(a)); }
HWY_INLINE Vectors where(Those mask, const Vectors& a, const Vectors& b) {
  return {hn::IfThenElse(mask, a.x, b.x), hn::IfThenElse(mask, a.y, b.y), hn::IfThenElse(mask, a.z, b.z)};
}
/// Elsewhere 0.
HWY_INLINE Vectors only(Those mask, const Vectors& a) {
  return {hn::IfThenElseZero(mask, a.x), hn::IfThenElseZero(mask, a.y), hn::IfThenElseZero(mask, a.z)};
}
/// `a` times the sign of `side`.
HWY_INLINE Vectors on_side(const Vectors& a, Some side) {
  return {hn::Mul(a.x, hn::CopySign(number(1), side)), hn::Mul(a.y, hn::CopySign(number(1), side)),
          hn::Mul(a.z, hn::CopySign(number(1), side))};
}
HWY_INLINE Those is_some(const Vectors& color) {
  return hn::Ne(hn::Add(hn::Abs(color.x), hn::Add(hn::Abs(color.y), hn::Abs(color.z))), hn::Zero(floats));
}
HWY_INLINE Vectors mirrored(const Vectors& direction, const Vectors& normal) {
  return plus_times(direction, normal, hn::Mul(number(-2), product(direction, normal)));
}
HWY_INLINE Vectors color(const PacketHits& hits, std::size_t field, std::size_t i) {
  return {take(hits.surface[field], i), take(hits.surface[field + 1], i), take(hits.surface[field + 2], i)};
}

/// Beside the surface, on the side that a ray goes to.
HWY_INLINE Vectors start_of(const PacketHits& hits, const Vectors& towards, std::size_t i) {
  const Vectors normal = take(hits.geometric_normal, i);
  const Some side = hn::CopySign(number(plain_offset), product(towards, normal));
  return plus_times(take(hits.point, i), normal, side);
}

void find_surfaces(PacketHits& hits, const VectorRow& ng, const float* triangles) {
  for (std::size_t i = 0; i < packet_rays; i += hn::Lanes(floats)) {
    const Vectors direction = take(hits.direction, i);
    const auto first = hn::Mul(hn::Load(integers, hits.triangle.data() + i), hn::Set(integers, std::int32_t{triangle_fields}));
    const auto field = [&](std::int32_t k) { return hn::GatherIndex(floats, triangles, hn::Add(first, hn::Set(integers, k))); };
    const Vectors geometric = of_unit_length(take(ng, i));
    const Some side = product(direction, geometric);
    const Vectors facing = on_side(geometric, hn::Neg(side));
    const Some u = take(hits.u, i), v = take(hits.v, i), rest = hn::Sub(hn::Sub(number(1), u), v);
    const Vectors first_part = times(Vectors{field(0), field(1), field(2)}, rest);
    const Vectors two_parts = plus_times(first_part, {field(3), field(4), field(5)}, u);
    const Vectors blended = plus_times(two_parts, {field(6), field(7), field(8)}, v);
    const Some square = product(blended, blended);
    const Vectors smooth = on_side(times(blended, hn::Div(number(1), hn::Sqrt(square))), product(blended, facing));
    put(plus_times(take(hits.origin, i), direction, take(hits.t, i)), hits.point, i);
    put(geometric, hits.geometric_normal, i);
    put(where(hn::Gt(square, hn::Zero(floats)), smooth, facing), hits.normal, i);
    put(hn::Gt(side, hn::Zero(floats)), hits.leaving, i);
    hn::Store(hn::BitCast(integers, field(9)), integers, hits.material.data() + i);
  }
}

void find_materials(PacketHits& hits, const float* materials) {
  for (std::size_t i = 0; i < packet_rays; i += hn::Lanes(floats)) {
    const auto first = hn::Mul(hn::Load(integers, hits.material.data() + i), hn::Set(integers, std::int32_t{material_fields}));
    for (std::size_t field = 0; field < material_fields; ++field) {
      const auto place = hn::Add(first, hn::Set(integers, static_cast<std::int32_t>(field)));
      put(hn::GatherIndex(floats, materials, place), hits.surface[field], i);
    }
    put(color(hits, own_field, i), hits.light, i);
  }
}

/// To the power of each surface's shine.
HWY_INLINE Some lobe_of(const PacketHits& hits, Some cosine, std::size_t i) {
  const Some base = hn::Min(hn::Max(cosine, number(1e-30F)), number(1));
  return hn::Exp(floats, hn::Mul(take(hits.surface[shine_field], i), hn::Log(floats, base)));
}

bool meet_light(const PacketHits& hits, const core::LightRecord& light, PacketLight& met) {
  const Vectors place{number(light.position.x), number(light.position.y), number(light.position.z)};
  const Vectors intensity{number(light.intensity.x), number(light.intensity.y), number(light.intensity.z)};
  bool is_anybody = false;
  for (std::size_t i = 0; i < packet_rays; i += hn::Lanes(floats)) {
    const Vectors towards = minus(place, take(hits.point, i)), normal = take(hits.normal, i);
    const Some cosine = product(towards, normal), scale = over_length(towards);
    const Those faces = hn::And(those(hits.active, i), hn::Gt(cosine, hn::Zero(floats)));
    Vectors surface = times(color(hits, diffuse_field, i), hn::Mul(cosine, scale));
    const Those glossy = hn::And(faces, hn::Gt(take(hits.surface[glossy_field], i), hn::Zero(floats)));
    if (!hn::AllFalse(floats, glossy)) {
      const Some lobe = lobe_of(hits, hn::Mul(product(mirrored(take(hits.direction, i), normal), towards), scale), i);
      surface = plus_times(surface, color(hits, highlight_field, i), lobe);
    }
    const Vectors brought = times(surface, intensity), start = start_of(hits, towards, i);
    const Those asked = hn::And(faces, is_some(brought));
    is_anybody |= !hn::AllFalse(floats, asked);
    put(asked, met.asked, i);
    put(only(asked, start), met.start, i);
    put(only(asked, minus(place, start)), met.way, i);
    put(brought, met.brought, i);
  }
  return is_anybody;
}

void add_light(PacketHits& hits, const PacketLight& met, const float* end) {
  for (std::size_t i = 0; i < packet_rays; i += hn::Lanes(floats)) {
    const Those came = hn::And(those(met.asked, i), hn::Ge(hn::LoadU(floats, end + i), hn::Zero(floats)));
    const Vectors sum = take(hits.light, i);
    put(where(came, plus(sum, take(met.brought, i)), sum), hits.light, i);
  }
}

HWY_INLINE void append(const PacketHits& hits, Those mask, const Vectors& towards, const Vectors& share, std::size_t i,
                       RayQueue& queue) {
  const Vectors start = start_of(hits, towards, i), weight = times(take(hits.weight, i), share);
  const auto add = [&](std::size_t row, const Vectors& values) {
    hn::CompressStore(values.x, mask, floats, queue.row[row].data() + queue.count);
    hn::CompressStore(values.y, mask, floats, queue.row[row + 1].data() + queue.count);
    hn::CompressStore(values.z, mask, floats, queue.row[row + 2].data() + queue.count);
  };
  add(0, start);
  add(3, towards);
  add(6, weight);
  queue.count += hn::CompressStore(hn::Load(integers, hits.pixel.data() + i), hn::RebindMask(integers, mask), integers,
                                   queue.pixel.data() + queue.count);
}

void send(const PacketHits& hits, RayQueue& reflected, RayQueue& refracted) {
  for (std::size_t i = 0; i < packet_rays; i += hn::Lanes(floats)) {
    const Vectors direction = take(hits.direction, i), normal = take(hits.normal, i);
    const Some inside = take(hits.surface[index_field], i), transmittance = take(hits.surface[transmittance_field], i);
    const Some index = hn::IfThenElse(those(hits.leaving, i), inside, hn::Div(number(1), inside));
    const Some cosine = hn::Neg(product(direction, normal));
    const Some behind = hn::NegMulAdd(hn::Mul(index, index), hn::NegMulAdd(cosine, cosine, number(1)), number(1));
    const Those total = hn::And(hn::Gt(index, number(1)), hn::Lt(behind, hn::Zero(floats)));
    const Some lost = hn::IfThenElseZero(total, transmittance);
    const Vectors share = plus(color(hits, mirrored_field, i), {lost, lost, lost});
    const Those active = those(hits.active, i), mirrors = hn::And(active, is_some(share));
    if (!hn::AllFalse(floats, mirrors)) {
      append(hits, mirrors, of_unit_length(mirrored(direction, normal)), share, i, reflected);
    }
    const Those refracts = hn::And(hn::AndNot(total, active), hn::Gt(transmittance, hn::Zero(floats)));
    if (!hn::AllFalse(floats, refracts)) {
      const Some along = hn::MulSub(index, cosine, hn::Sqrt(hn::Max(behind, hn::Zero(floats))));
      const Vectors bent = of_unit_length(plus_times(times(direction, index), normal, along));
      append(hits, refracts, bent, {transmittance, transmittance, transmittance}, i, refracted);
    }
  }
}

const PacketShading* shading() {
  static constexpr PacketShading all{find_surfaces, find_materials, meet_light, add_light, send};
  return &all;
}

}  // namespace dmpc::apps::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dmpc::apps {
const PacketShading& packet_shading() { return *DMPC_COMPILED_FOR(0, shading)(); }

void RayQueue::reserve_more(std::size_t more) {
  const std::size_t least = count + more + packet_rays;
  if (pixel.size() >= least) {
    return;
  }
  for (std::vector<float>& numbers : row) {
    numbers.resize(2 * least);
  }
  pixel.resize(2 * least);
}

void RayQueue::close(std::size_t end) {
  for (std::vector<float>& numbers : row) {
    std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(count), numbers.begin() + static_cast<std::ptrdiff_t>(end), 0.0F);
  }
}

}  // namespace dmpc::apps
#endif
