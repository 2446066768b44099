// The picture's sums, in fixed point, so that they do not depend on the order of the deposits.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/vec.h"
#include "core/base/zeroed_array.h"

namespace dmpc::core {

/// RGB sums in units of 2^-32. A sum reaches 2^31 before it saturates: 2^15 samples of radiance 2^16. Deposits are >= 0, so a
/// saturating sum does not depend on the order either.
struct FixedColor {
  std::array<std::int64_t, 3> channel{};
  constexpr bool operator==(const FixedColor&) const = default;
};
inline constexpr double film_resolution = 1.0 / 4294967296.0;

/// Rounds a deposit once, where it arises. Negative or NaN channels deposit 0, too large ones saturate.
FixedColor to_fixed(const Color& light);
/// Adds, saturating; returns whether a channel saturated.
bool add(FixedColor& sum, const FixedColor& deposit);

/// A pixel's sums over its even and over its odd samples: their difference estimates the error.
struct PixelSums {
  std::array<FixedColor, 2> plane;
  constexpr bool operator==(const PixelSums&) const = default;
};
static_assert(sizeof(PixelSums) == 48);

/// All pixels, row by row from the top left. Not thread-safe; the host owns it.
class Film {
 public:
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Adds a node's sums of one pixel; returns whether a channel saturated. Requires pixel < width * height.
  bool deposit(std::uint32_t pixel, const PixelSums& sums);
  std::span<const PixelSums> pixels() const { return pixels_.span(); }
  /// Says that a pixel's deposits are those of so many more samples, half of them even or one more.
  void add_samples(std::uint32_t pixel, std::uint32_t count) { samples_[pixel] += count; }
  std::uint32_t samples(std::uint32_t pixel) const { return samples_[pixel]; }
  /// The samples of all pixels.
  std::uint64_t samples() const;
  /// Mean linear radiance of a pixel; requires samples(pixel) > 0.
  Vec3d radiance(std::uint32_t pixel) const;
  /// Half of the difference between the means of its even and its odd samples; requires samples(pixel) > 1.
  Vec3d half_difference(std::uint32_t pixel) const;
  /// FNV-1a over the sums and the size: equal pictures, equal hashes.
  std::uint64_t hash() const;

 private:
  int width_, height_;
  ZeroedArray<PixelSums> pixels_;
  ZeroedArray<std::uint32_t> samples_;
};

}  // namespace dmpc::core
