// Textures as records: tables of addresses, and the tiles that they name.
#pragma once

#include <cstdint>
#include <functional>

#include "core/database/record_writer.h"
#include "core/record/record.h"
#include "core/scene/texture.h"

namespace dmpc::core {

/// How shading records are to name a texture: its table of tiles is an array that `writer` has room for now. Throws InputError
/// for a texture that is larger than Texture::size_max along a side.
TextureReference reference_to(const Texture& texture, RecordWriter& writer);

/// Writes a texture's tiles, from the beginning of a page, level by level, each in Morton order, so that neighbours share pages,
/// and their addresses to the table that `reference` names.
void write_tiles(const Texture& texture, const TextureReference& reference, RecordWriter& writer);

/// Which tiles of one of its textures a textured triangle may ask for, whatever the ray: on every level those about the rectangle
/// in which its corners lie on the texture.
void for_each_tile(const TexturedNormals& triangle, const TextureReference& texture,
                   const std::function<void(std::uint32_t)>& take);

}  // namespace dmpc::core
