// A filtered look-up in a texture, resumable between any two of its records.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"
#include "core/picture/surfaces/texture_footprint.h"
#include "core/record/record.h"
#include "core/trace/operations.h"

namespace dmpc::core {

/// The mean over a footprint by up to probes_max probes. Each is trilinear (L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983):
/// the four texels around a point on each of the two levels whose texels are closest in size to the probe's width. Level by
/// level, probe by probe, tile by tile: at most 8 tiles per probe, each found through an entry of the texture's table, one record
/// per step; consecutive probes in one tile share the step. The footprint's middle is kept by the owner.
struct TextureLookup {
  Color sum;                       ///< weighted sum of the texels so far
  std::array<float, 2> stride{};   ///< from probe to probe: s and t
  Address tiles = no_address;      ///< as in the texture's reference, also the members below
  std::uint32_t tile : 31 = 0;     ///< the next one: its number in the texture's table; once that has been read, its address
  std::uint32_t is_found : 1 = 0;  ///< `tile` is an address
  std::uint16_t width = 1, height = 1;
  std::uint16_t coarse_share = 0;  ///< the coarser level's, in 1/65536
  std::uint16_t end_share = 0;     ///< weight of the first and of the last probe, in 1/65536: minus one
  TexelFormat format : 3 = {};
  TextureWrap wrap_s : 2 = {}, wrap_t : 2 = {};
  std::uint32_t level : 4 = 0;      ///< the finer one
  std::uint32_t ends : 3 = 0;       ///< number of probes on either side of the middle one
  std::uint32_t probe : 4 = 0;      ///< the next one, from one end to the other
  std::uint32_t quarter : 2 = 0;    ///< which of the probe's tiles: bit 1 in the lower row, bit 0 on the right
  std::uint32_t is_coarse : 1 = 0;  ///< on the coarser level
  std::uint32_t is_done : 1 = 0;
};
static_assert(sizeof(TextureLookup) == 40 && std::is_trivially_copyable_v<TextureLookup>);

TextureLookup begin_lookup(const TextureReference& texture, const TextureFootprint& footprint);

/// Starts again on another texture at the same place: along the same line, by probes that are `width` of its texels wide.
/// `middle`: the footprint's.
void turn_to(TextureLookup& lookup, const TextureReference& texture, double width, const TexturePlace& middle);

/// Everything has been read, and `sum` is the colour; with alpha it is premultiplied, to be divided by alpha.
inline bool is_finished(const TextureLookup& lookup) { return lookup.is_done != 0; }

/// The record that the next step reads. Requires a look-up that is not finished, also below.
Address record_needed(const TextureLookup& lookup);

/// One step; `record` is that of record_needed(), `middle` the footprint's. For a format with alpha, adds the weighted alpha to
/// `alpha`.
void step(TextureLookup& lookup, const TexturePlace& middle, const std::byte* record, Operations& operations, float& alpha);

}  // namespace dmpc::core
