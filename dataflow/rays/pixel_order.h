// In which order the pixels of a picture start their primary rays.
#pragma once

#include <algorithm>
#include <cstdint>

namespace dmpc::dataflow {

/// The pixels of a picture, one behind the other; a pixel's primary rays are numbered by its place. A value of two numbers, that
/// all nodes have.
class PixelOrder {
 public:
  /// Of the squares, in pixels: one holds as many as a bundle has rays (core::bundle_rays_max).
  static constexpr std::uint32_t side = 4;

  /// Row by row: a place is a pixel's number.
  constexpr PixelOrder() = default;
  /// In squares of 4x4 pixels, each row by row, at the right and the bottom what is left of one: 16 rays that start together are
  /// neighbours, and meet the same.
  static constexpr PixelOrder squares(std::uint32_t width, std::uint32_t height) { return {width, height}; }

  /// The number of the pixel at `place`, which is less than their count.
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

  std::uint32_t width_ = 0, height_ = 0;  ///< of the picture, if it is in squares
};

}  // namespace dmpc::dataflow
