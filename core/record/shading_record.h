// The records that shading reads of what a ray has hit, and how long they are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/expect.h"
#include "core/record/record.h"

namespace dmpc::core {

/// block: of the primitive that was hit. normals: a PatchNormals, TexturedNormals or FacetedNormals. tile: a TextureTile.
enum class ShadingRecord : std::uint8_t { block, normals, tile };

/// The most that one takes.
constexpr std::size_t bytes_max(ShadingRecord kind) {
  return kind == ShadingRecord::block     ? record_bytes_max
         : kind == ShadingRecord::normals ? sizeof(FacetedNormals)
                                          : sizeof(TextureTile);
}

/// What a PatchNormals takes with all that it begins.
inline std::size_t bytes_of_normals(const std::byte* record) {
  return !read<PatchNormals>(record).is_textured()       ? sizeof(PatchNormals)
         : read<TexturedNormals>(record).has_facets != 0 ? sizeof(FacetedNormals)
                                                         : sizeof(TexturedNormals);
}

/// What this one takes.
inline std::size_t bytes_of(ShadingRecord kind, const std::byte* record) {
  switch (kind) {
    case ShadingRecord::block:
      return block_bytes(read<BlockHeader>(record));
    case ShadingRecord::normals:
      return bytes_of_normals(record);
    case ShadingRecord::tile:
      return sizeof(TextureTile);
  }
  expect(false, "shading reads a record of a known kind");
  return 0;
}

}  // namespace dmpc::core
