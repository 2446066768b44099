// The picture's sums, in fixed point, so that they do not depend on the order of the deposits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/vec.h"
#include "core/base/zeroed_array.h"

namespace dmpc::core {

/// By what a film multiplies light before it is held: a power of two, 1 but for scenes whose light is far beyond what the film's
/// own units can hold (film_scale_for()).
struct FilmScale {
  /// Which keep the factor and what it multiplies a double.
  static constexpr int exponent_max = 256;

  std::int32_t exponent = 0;  ///< of 2; -exponent_max to exponent_max

  constexpr double factor() const { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52U); }
  constexpr bool operator==(const FilmScale&) const = default;
};

/// RGB sums of scaled light in units of 2^-32. A sum reaches 2^31 before it saturates: 2^15 samples of 2^16. Deposits are not below
/// 0, so a saturating sum does not depend on the order either.
struct FixedColor {
  std::array<std::int64_t, 3> channel{};
  constexpr bool operator==(const FixedColor&) const = default;
};
inline constexpr double film_resolution = 1.0 / 4294967296.0;

/// Where a channel saturates.
inline constexpr std::int64_t film_channel_max = std::numeric_limits<std::int64_t>::max();

/// Scales and rounds a deposit once, where it arises. Negative or NaN channels deposit 0, too large ones saturate.
FixedColor to_fixed(const Color& light, FilmScale scale = {});
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
  Film(int width, int height, FilmScale scale = {});

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of all deposits.
  FilmScale scale() const { return scale_; }
  /// The least radiance that a deposit can have.
  double step() const { return film_resolution / scale_.factor(); }
  /// Adds a node's sums of one pixel; returns whether a channel saturated. Requires pixel < width * height.
  bool deposit(std::uint32_t pixel, const PixelSums& sums);
  std::span<const PixelSums> pixels() const { return pixels_.span(); }
  /// Says that a pixel's deposits are those of so many more samples, half of them even or one more.
  void add_samples(std::uint32_t pixel, std::uint32_t count) { samples_[pixel] += count; }
  std::uint32_t samples(std::uint32_t pixel) const { return samples_[pixel]; }
  /// The samples of all pixels.
  std::uint64_t samples() const;
  /// Mean linear radiance of a pixel; requires samples(pixel) > 0.
  Vec3d radiance(std::uint32_t pixel) const { return scaled_mean(pixel) * (1 / scale_.factor()); }
  /// The same, scaled.
  Vec3d scaled_mean(std::uint32_t pixel) const;
  /// Half of the difference between the scaled means of its even and its odd samples; requires samples(pixel) > 1.
  Vec3d half_difference(std::uint32_t pixel) const;
  /// FNV-1a over the sums, the size and the scale, if that is not 1: equal pictures, equal hashes.
  std::uint64_t hash() const;

 private:
  int width_, height_;
  FilmScale scale_;
  ZeroedArray<PixelSums> pixels_;
  ZeroedArray<std::uint32_t> samples_;
};

}  // namespace dmpc::core
