// Vectors over the lanes of a bundle; included once for each instruction set, after hwy/highway.h.
#if defined(DMPC_CORE_TRACE_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef DMPC_CORE_TRACE_LANES
#undef DMPC_CORE_TRACE_LANES
#else
#define DMPC_CORE_TRACE_LANES
#endif

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/trace/bundle.h"

HWY_BEFORE_NAMESPACE();
namespace dmpc::core::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, bundle_rays_max>;
using Integers = hn::CappedTag<std::int32_t, bundle_rays_max>;
using Unsigned = hn::CappedTag<std::uint32_t, bundle_rays_max>;
using Doubles = hn::CappedTag<double, bundle_rays_max>;
/// As many as Doubles has.
using HalfFloats = hn::Rebind<float, Doubles>;
using HalfIntegers = hn::Rebind<std::int32_t, Doubles>;

template <class Tag>
constexpr std::size_t lanes_of() {
  return hn::MaxLanes(Tag());
}

constexpr RayMask first_bits(std::size_t count) { return (RayMask{1} << count) - 1; }

/// A bit for each lane: by a word that they fill, since to put bytes together takes four instructions more.
template <class Tag>
HWY_INLINE RayMask bits_of(Tag tag, hn::Mask<Tag> mask) {
  using Word = std::conditional_t<lanes_of<Tag>() <= 8, std::uint8_t, std::uint16_t>;
  static_assert(sizeof(Word) == 1 || std::endian::native == std::endian::little);
  Word words[8 / sizeof(Word)] = {};
  hn::StoreMaskBits(tag, mask, reinterpret_cast<std::uint8_t*>(words));
  return words[0];
}

/// The lanes whose bits are set; those above are ignored.
template <class Tag>
HWY_INLINE hn::Mask<Tag> mask_of(Tag tag, RayMask bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U)};
  return hn::LoadMaskBits(tag, bytes);
}

/// a * b + c, rounded once: by libm where the instruction set cannot, so that all have the same bits.
template <class Vector>
HWY_INLINE Vector fused(Vector a, Vector b, Vector c) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || HWY_TARGET == HWY_SSSE3 || HWY_TARGET == HWY_SSE4
  const Floats tag;
  alignas(64) float x[lanes_of<Floats>()], y[lanes_of<Floats>()], z[lanes_of<Floats>()];
  hn::Store(a, tag, x);
  hn::Store(b, tag, y);
  hn::Store(c, tag, z);
  for (std::size_t i = 0; i < lanes_of<Floats>(); ++i) {
    z[i] = std::fma(x[i], y[i], z[i]);
  }
  return hn::Load(tag, z);
#else
  return hn::MulAdd(a, b, c);
#endif
}

}  // namespace dmpc::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
