// The tiles of a picture in which a box may be visible.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/box.h"
#include "core/picture/camera/camera.h"

namespace dmpc::core {

inline constexpr std::uint32_t tiles_per_side = 64;

/// One side of a picture, cut into 64 tiles, some without a pixel if it has fewer pixels.
struct TiledSide {
  std::uint64_t tiles_a_pixel = 0;  ///< in units of 2^-32

  static TiledSide of(int pixels) { return {(std::uint64_t{tiles_per_side} << 32U) / static_cast<std::uint64_t>(pixels)}; }
  /// Rises with the pixel's column or row; below 64.
  std::uint32_t tile_of(std::uint32_t pixel) const { return static_cast<std::uint32_t>(pixel * tiles_a_pixel >> 32U); }
};

/// The tiles at the crossings of some columns and rows of tiles, a bit each.
struct TileFootprint {
  std::uint64_t columns = 0, rows = 0;
};

/// Projects boxes onto the film of a camera. Immutable, thread-safe.
class BoxProjector {
 public:
  explicit BoxProjector(const Camera& camera);

  /// False if nothing can be said of this camera: its angle is close to 0 or 180 degrees, or one of its numbers is not finite.
  /// Then no other function may be called.
  bool is_certain() const { return is_certain_; }
  /// All tiles that have a pixel.
  TileFootprint all() const { return {across_.tiles(), down_.tiles()}; }
  /// All tiles through whose pixels a primary ray may hit the box (grid-local), wherever its sample lies in a pixel. The box is
  /// widened on every side by half a pixel, by the rounding error of rays (tile_footprint.cpp), and by one more pixel.
  TileFootprint footprint_of(const Box& box) const;

 private:
  /// The part of a box that lies ahead of the eye, by its corners on the film (Camera::on_film).
  struct Proxy {
    std::array<Vec3d, 20> corners;  ///< corners of the box, and where its edges reach depth 0
    std::size_t count = 0;
    bool is_cut = false;

    void add(const Vec3d& corner) { corners[count++] = corner; }
  };

  /// The picture's columns or rows.
  class Side {
   public:
    Side(int pixels, double margin_pixels);
    /// Tiles that have a pixel.
    std::uint64_t tiles() const { return tiles_; }
    /// `axis`: 0 for columns, 1 for rows. The proxy has a corner.
    std::uint64_t footprint_of(const Proxy& proxy, std::size_t axis) const {
      return proxy.is_cut ? footprint_of_cut(proxy, axis) : footprint_of_whole(proxy, axis);
    }

   private:
    std::uint64_t footprint_of_whole(const Proxy& proxy, std::size_t axis) const;
    std::uint64_t footprint_of_cut(const Proxy& proxy, std::size_t axis) const;

    int pixels_;
    double margin_pixels_;
    TiledSide tiled_;
    std::uint64_t tiles_ = 0;
    std::array<double, tiles_per_side> first_{}, last_{};  ///< edges of tiles, widened
  };

  Proxy proxy_of(const Box& box) const;

  Vec3d eye_;
  std::array<Vec3d, 3> axes_;  ///< one step along each of the grid's axes, on the film
  Side across_, down_;
  bool is_certain_;
};

}  // namespace dmpc::core
