// The parts of a picture that show only the background: found on the host, known to every node.
#pragma once

#include <array>
#include <cstdint>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "core/picture/camera/tile_footprint.h"

namespace dmpc::core {

/// A picture cut into 64x64 tiles with a bit each: set if primary rays through the tile's pixels are certain to hit nothing,
/// wherever their samples lie in a pixel. None is set by default. Copyable as bytes.
class BackgroundTiles {
 public:
  /// By row of tiles; bit i is column i.
  using Bits = std::array<std::uint64_t, tiles_per_side>;

  BackgroundTiles() = default;
  /// The tiles of the camera's picture.
  BackgroundTiles(const Camera& camera, const Bits& bits);

  /// Whether the pixel lies in a tile whose bit is set.
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
  /// Number of tiles whose bit is set.
  std::uint32_t count() const { return count_; }

 private:
  TiledSide across_, down_;
  std::uint32_t width_ = 1;
  std::uint32_t count_ = 0;
  Bits bits_{};
};

/// Projects the boxes of the database's BVH nodes, and of primitives in leaves, onto the camera's film, from the top down, while
/// they may fall on a tile that is still empty. With a sky's picture no tile is background, since each ray that hits nothing
/// reads its own record. Reads database.bytes(). Takes less than a millisecond for a million primitives. Thread safety: pure.
BackgroundTiles find_background(const Database& database, const Camera& camera);

}  // namespace dmpc::core
