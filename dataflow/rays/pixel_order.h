// The order in which the pixels of a picture start their primary rays.
#pragma once

#include <algorithm>
#include <cstdint>

namespace dmpc::dataflow {

/// A permutation of the pixels of a picture; a pixel's primary rays are numbered by its place. A value of two numbers, known to
/// all nodes.
class PixelOrder {
 public:
  /// The side of the squares, in pixels: a square has as many as a bundle has rays (core::bundle_rays_max).
  static constexpr std::uint32_t side = 4;

  /// Row by row: a place is a pixel's index.
  constexpr PixelOrder() = default;
  /// In squares of 4x4 pixels, each row by row, clipped at the right and the bottom: 16 rays that start together are neighbours,
  /// and hit the same primitives.
  static constexpr PixelOrder squares(std::uint32_t width, std::uint32_t height) { return {width, height}; }

  /// The index of the pixel at `place`, which is less than their count.
  constexpr std::uint32_t pixel_at(std::uint32_t place) const {
    if (width_ == 0) {
      return place;
    }
    const std::uint32_t y = place / (side * width_) * side, of_band = place - y * width_, height = std::min(side, height_ - y);
    const std::uint32_t x = of_band / (side * height) * side, of_square = of_band - x * height;
    const std::uint32_t width = std::min(side, width_ - x);
    return (y + of_square / width) * width_ + x + of_square % width;
  }

  bool operator==(const PixelOrder&) const = default;

 private:
  constexpr PixelOrder(std::uint32_t width, std::uint32_t height) : width_(width), height_(height) {}

  std::uint32_t width_ = 0, height_ = 0;  ///< the picture's, if in squares
};

}  // namespace dmpc::dataflow
