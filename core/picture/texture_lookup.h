// A filtered look-up in a texture, resumable between any two of its records.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"
#include "core/record/record.h"
#include "core/trace/operations.h"

namespace dmpc::core {

/// Trilinear (L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983): the four texels about a place on each of the two levels whose
/// texels are next in size to what the ray's cone covers. Level by level, and tile by tile in each: at most 8 tiles, each found
/// by an entry of the texture's table, one record a step. The place itself is its owner's to keep.
struct TextureLookup {
  Color sum;  ///< of the texels so far, by their weights
  TextureReference texture;
  std::uint32_t tile = 0;          ///< that is due: its number in the texture's table; once that has been read, its address
  std::uint16_t coarse_share = 0;  ///< of the coarser level, in 1/65536
  std::uint8_t level = 0;          ///< the finer one
  std::uint8_t turn : 4 = 0;       ///< which tile: bit 2 on the coarser level, bit 1 in the lower row, bit 0 on the right
  bool is_found : 1 = false;       ///< its address is known
};
static_assert(sizeof(TextureLookup) == 32 && std::is_trivially_copyable_v<TextureLookup>);

/// A place on a texture: s to the right, t downwards.
struct TexturePlace {
  double s = 0, t = 0;
};

/// Of what covers `texels` texels of the finest level across, not below 0.
TextureLookup begin_lookup(const TextureReference& texture, const TexturePlace& place, double texels);

/// All has been read, and `sum` is the colour.
bool is_finished(const TextureLookup& lookup);

/// What the next step reads. Requires a look-up that is not finished, here and below.
Address record_needed(const TextureLookup& lookup);

/// One step; `record` is that of record_needed().
void step(TextureLookup& lookup, const TexturePlace& place, const std::byte* record, Operations& operations);

}  // namespace dmpc::core
