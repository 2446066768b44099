// Groups the pixels of a picture into square cells if there are too many to be played one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::apps::html {

/// Cells, row by row from the top left; their side is the least power of two that gives at most `cells_max` of them.
class PlayCells {
 public:
  /// Requires a picture with a pixel, and `cells_max` > 0.
  PlayCells(int width, int height, std::size_t cells_max);

  /// In pixels; the last cells of a row or column may have fewer.
  int side() const { return side_; }
  int wide() const { return count(width_); }
  int high() const { return count(height_); }

  // Reduce values by pixel to values by cell.
  std::vector<std::uint64_t> sums(std::span<const std::uint64_t> values) const;
  std::vector<std::uint64_t> largest(std::span<const std::uint64_t> values) const;
  /// Takes the value of each cell's pixel that was done last; of several the first.
  std::vector<std::uint64_t> of_last(std::span<const std::uint64_t> values, std::span<const std::uint64_t> done) const;

 private:
  int count(int pixels) const { return (pixels + side_ - 1) / side_; }
  std::size_t cell_of(std::size_t pixel) const;
  std::size_t cell_count() const { return static_cast<std::size_t>(wide()) * static_cast<std::size_t>(high()); }

  int width_, height_;
  int side_ = 1;
};

}  // namespace dmpc::apps::html
