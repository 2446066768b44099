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
/// the four texels about a place on each of the two levels whose texels are next in size to the probe's width. Level by level,
/// probe by probe, tile by tile: at most 8 tiles for each probe, each found by an entry of the texture's table, one record a
/// step; probes that follow each other in one tile share the step. The footprint's middle is its owner's to keep.
struct TextureLookup {
  Color sum;                       ///< of the texels so far, by their weights
  std::array<float, 2> stride{};   ///< from probe to probe: s and t
  Address tiles = no_address;      ///< here and below: what the texture's reference says
  std::uint32_t tile : 31 = 0;     ///< that is due: its number in the texture's table; once that has been read, its address
  std::uint32_t is_found : 1 = 0;  ///< its address is known
  std::uint16_t width = 1, height = 1;
  std::uint16_t coarse_share = 0;  ///< of the coarser level, in 1/65536
  std::uint16_t end_share = 0;     ///< what there is of the first and of the last probe, in 1/65536: one more
  TexelFormat format : 3 = {};
  TextureWrap wrap_s : 2 = {}, wrap_t : 2 = {};
  std::uint32_t level : 4 = 0;      ///< the finer one
  std::uint32_t ends : 3 = 0;       ///< the number of probes on either side of the one in the middle
  std::uint32_t probe : 4 = 0;      ///< from one end to the other: the one that is due
  std::uint32_t quarter : 2 = 0;    ///< which tile of its: bit 1 in the lower row, bit 0 on the right
  std::uint32_t is_coarse : 1 = 0;  ///< on the coarser level
  std::uint32_t is_done : 1 = 0;
};
static_assert(sizeof(TextureLookup) == 40 && std::is_trivially_copyable_v<TextureLookup>);

TextureLookup begin_lookup(const TextureReference& texture, const TextureFootprint& footprint);

/// Begins anew on another texture that lies at the same places: along the same line, by probes that are `width` of its texels
/// wide. `middle` is the footprint's.
void turn_to(TextureLookup& lookup, const TextureReference& texture, double width, const TexturePlace& middle);

/// All has been read, and `sum` is the colour; of a format with alpha it is what of it is there, which alpha divides.
inline bool is_finished(const TextureLookup& lookup) { return lookup.is_done != 0; }

/// What the next step reads. Requires a look-up that is not finished, here and below.
Address record_needed(const TextureLookup& lookup);

/// One step; `record` is that of record_needed(), `middle` the footprint's. Of a format with alpha, adds to `alpha` what is met
/// of it, by its weights.
void step(TextureLookup& lookup, const TexturePlace& middle, const std::byte* record, Operations& operations, float& alpha);

}  // namespace dmpc::core
