// The distribution of the image, one part per node, and a part as work items: taken in scan order, given away from the far end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>

#include "core/picture/sampling/sample_pass.h"

namespace dmpc::svm {

/// Pixels in columns and rows: from (x, y) on `width` of them side by side, every step_x-th of the image, in `height` rows, every
/// step_y-th. With steps of 1 a rectangle of the image, [x, x + width) x [y, y + height).
struct PixelRectangle {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
  std::uint32_t step_x = 1, step_y = 1;

  constexpr std::uint64_t pixel_count() const { return std::uint64_t{width} * height; }
  /// The index, in an image of this width, of the pixel in this column and row.
  constexpr std::uint32_t pixel(std::uint32_t column, std::uint32_t row, std::uint32_t image_width) const {
    return (y + row * step_y) * image_width + x + column * step_x;
  }
  /// The index of the pixel at this place, row by row. Requires a place below pixel_count().
  constexpr std::uint32_t pixel_at(std::uint64_t place, std::uint32_t image_width) const {
    return pixel(static_cast<std::uint32_t>(place % width), static_cast<std::uint32_t>(place / width), image_width);
  }
  constexpr bool operator==(const PixelRectangle&) const = default;
};

/// The part of the image that node `index` starts with, if the first `worker_count` nodes render; empty for the others. The
/// submaps of all workers cover each pixel exactly once; they are nearly square and of nearly equal area (the longer side is cut
/// in proportion to the workers on each side, recursively); if there are more workers than pixels, some are empty.
PixelRectangle submap_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count);

/// The pixels that node `index` of the first `worker_count` starts with if they are interleaved, as in the frame buffer of the
/// Pixel Machine (M. Potmesil, E. Hoffert, "The Pixel Machine: A Parallel Image Computer", 1989): of every n-th line every m-th
/// pixel, each node at a different offset; empty for the other nodes. m x n is the number of workers, m >= n, as nearly square as
/// possible: a prime number of them is one row, and parts beyond the image's columns are empty.
PixelRectangle interleaved_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count);

/// The pixels that a node starts with.
enum class PixelShares : std::uint8_t {
  submaps,     ///< a rectangle
  interleaved  ///< every m-th pixel of every n-th line
};
/// As the command line calls it.
constexpr const char* name_of(PixelShares shares) { return shares == PixelShares::submaps ? "submaps" : "interleaved"; }

/// submap_of() or interleaved_of().
PixelRectangle share_of(const PixelRectangle& image, std::uint32_t index, std::uint32_t worker_count, PixelShares shares);

/// The rest of a node's share of the image, as items of side x side of its pixels, clipped at the share's edge: if pixels are
/// interleaved, those of an item are as far apart as the share's. Needs no further memory.
class WorkItems {
 public:
  /// `side` 0 makes the whole share one item.
  WorkItems(const PixelRectangle& share, std::uint32_t side);

  bool empty() const { return next_ == end_; }
  std::uint64_t count() const { return end_ - next_; }
  /// The next item in scan order, which is not removed.
  std::optional<PixelRectangle> front() const;
  /// The next item in scan order, for the node itself.
  std::optional<PixelRectangle> take();
  /// The last item in scan order, for another node: the one that its owner would have come to last.
  std::optional<PixelRectangle> give();

 private:
  PixelRectangle item(std::uint64_t index) const;

  PixelRectangle share_;
  std::uint32_t side_x_, side_y_;  ///< unclipped item's sides
  std::uint64_t columns_ = 0;      ///< items side by side
  std::uint64_t next_ = 0, end_ = 0;
};

/// The maximum number of pixels along a side of a masked item, so that a small packet has a step for each of its pixels.
inline constexpr std::uint32_t masked_side_max = 4;
/// The steps of the pixels of a masked item, row by row; those beyond it add no samples.
using ItemSteps = std::array<core::SampleStep, std::size_t{masked_side_max} * masked_side_max>;

/// Pixels that one task takes at a time.
struct PixelTile {
  std::uint32_t width = 1, height = 1;

  constexpr std::uint32_t pixel_count() const { return width * height; }
  constexpr bool operator==(const PixelTile&) const = default;
};

/// The tile of at most `pixels_max` pixels, at least 1, that is nearest to a square with sides of powers of two.
constexpr PixelTile tile_of(std::uint32_t pixels_max) {
  PixelTile tile;
  for (bool wider = true; 2 * tile.pixel_count() <= pixels_max; wider = !wider) {
    (wider ? tile.width : tile.height) *= 2;
  }
  return tile;
}

/// The tile of a task of at most `pixels_a_task` pixels, a power of two, which is also the number of a bundle's rays: the fewest
/// pixels whose samples fill bundles.
constexpr PixelTile tile_for(std::uint32_t samples, std::uint32_t pixels_a_task) {
  return tile_of(pixels_a_task / std::gcd(samples > 0 ? samples : 1, pixels_a_task));
}

/// The pixels of one item, or those of them that are wanted: tile by tile, row by row, and in the same order within a tile,
/// clipped at the item's edge. With tiles of one pixel this is row by row.
class PixelScan {
 public:
  PixelScan() = default;
  explicit PixelScan(const PixelRectangle& item, const PixelTile& tile = {})
      : item_(item), tile_(tile), left_(item.pixel_count()) {}
  /// `wanted`: a bit for each pixel, row by row. Requires at most 64 pixels.
  PixelScan(const PixelRectangle& item, const PixelTile& tile, std::uint64_t wanted);

  bool empty() const { return left_ == 0; }
  /// Whether the next pixel lies in the tile of the one before.
  bool stays_in_tile() const { return left_ > 0 && in_tile_; }
  /// The next pixel's place in the item, row by row. Requires !empty().
  std::uint64_t place() const { return std::uint64_t{y_} * item_.width + x_; }
  /// The next pixel's index in an image of this width. Requires !empty().
  std::uint32_t next(std::uint32_t image_width);

 private:
  bool is_wanted() const { return !wanted_ || (*wanted_ >> place() & 1U) != 0; }
  void step();

  PixelRectangle item_;
  PixelTile tile_;
  std::uint32_t x_ = 0, y_ = 0;  ///< the next pixel's, in the item
  bool in_tile_ = false;
  std::uint64_t left_ = 0;
  std::optional<std::uint64_t> wanted_;
};

}  // namespace dmpc::svm
