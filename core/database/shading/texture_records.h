// Textures as records: tables of addresses, and the tiles that they name.
#pragma once

#include <cstdint>
#include <functional>

#include "core/database/record_writer.h"
#include "core/record/record.h"
#include "core/scene/texture.h"

namespace dmpc::core {

/// How shading records refer to a texture: its table of tiles is an array that is allocated in `writer`. Throws InputError for a
/// texture larger than Texture::size_max along a side.
TextureReference reference_to(const Texture& texture, RecordWriter& writer);

/// Writes a texture's tiles, from the beginning of a page, level by level, each in Morton order, so that neighbours share pages,
/// and their addresses to the table of `reference`.
void write_tiles(const Texture& texture, const TextureReference& reference, RecordWriter& writer);

/// The tiles of one of its textures that a textured triangle may need for any ray: on every level those around the bounding
/// rectangle of its corners on the texture.
void for_each_tile(const TexturedNormals& triangle, const TextureReference& texture,
                   const std::function<void(std::uint32_t)>& take);

}  // namespace dmpc::core
