// The records that shading reads of what a ray has hit, and how long they are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/expect.h"
#include "core/record/record.h"

namespace dmpc::core {

/// block: of the primitive that was hit. normals: a PatchNormals or TexturedNormals. tile: a TextureTile.
enum class ShadingRecord : std::uint8_t { block, normals, tile };

/// The most that one takes.
constexpr std::size_t bytes_max(ShadingRecord kind) {
  return kind == ShadingRecord::block     ? record_bytes_max
         : kind == ShadingRecord::normals ? sizeof(TexturedNormals)
                                          : sizeof(TextureTile);
}

/// What this one takes.
inline std::size_t bytes_of(ShadingRecord kind, const std::byte* record) {
  switch (kind) {
    case ShadingRecord::block:
      return block_bytes(read<BlockHeader>(record));
    case ShadingRecord::normals:
      return read<PatchNormals>(record).is_textured() ? sizeof(TexturedNormals) : sizeof(PatchNormals);
    case ShadingRecord::tile:
      return sizeof(TextureTile);
  }
  expect(false, "shading reads a record of a known kind");
  return 0;
}

}  // namespace dmpc::core
