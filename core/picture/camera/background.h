// Which parts of a picture show nothing but the background: found on the host, known to every node.
#pragma once

#include <array>
#include <cstdint>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "core/picture/camera/tile_footprint.h"

namespace dmpc::core {

/// A picture cut into 64x64 tiles with a bit each: set if primary rays through the tile's pixels, wherever in a pixel their
/// samples lie, are certain to meet nothing. None is set by default. Copyable as bytes.
class BackgroundTiles {
 public:
  /// By row of tiles; bit i is column i.
  using Bits = std::array<std::uint64_t, tiles_per_side>;

  BackgroundTiles() = default;
  /// The tiles of the camera's picture.
  BackgroundTiles(const Camera& camera, const Bits& bits);

  /// Whether a pixel of the picture lies in one of them.
  bool has(std::uint32_t pixel) const {
    return count_ > 0 && (bits_[down_.tile_of(pixel / width_)] >> across_.tile_of(pixel % width_) & 1U) != 0;
  }
  /// Whether all pixels of a rectangle of the picture, from (x, y) on, do.
  bool covers(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) const {
    std::uint64_t columns = 0, common = count_ > 0 ? ~std::uint64_t{0} : 0;
    for (std::uint32_t i = 0; i < width; ++i) {
      columns |= std::uint64_t{1} << across_.tile_of(x + i);
    }
    for (std::uint32_t i = 0; i < height; ++i) {
      common &= bits_[down_.tile_of(y + i)];
    }
    return (columns & ~common) == 0;
  }
  /// Tiles whose bit is set.
  std::uint32_t count() const { return count_; }

 private:
  TiledSide across_, down_;
  std::uint32_t width_ = 1;
  std::uint32_t count_ = 0;
  Bits bits_{};
};

/// Projects the boxes of the database's BVH nodes, and those of primitives in leaves, onto the camera's film, from the top down,
/// as long as they may fall on a tile on which none has fallen. Below a sky's picture there are none, since each ray that meets
/// nothing asks for a record of its own. Reads database.bytes(). Takes less than a millisecond for a million primitives. Thread
/// safety: pure.
BackgroundTiles find_background(const Database& database, const Camera& camera);

}  // namespace dmpc::core
