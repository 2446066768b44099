// The picture's sums, in fixed point, so that they do not depend on the order of deposits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/vec.h"
#include "core/base/zeroed_array.h"

namespace dmpc::core {

/// The factor by which a film scales light: a power of two, 1 except for scenes whose light is far outside the range of the
/// film's units (film_scale_for()).
struct FilmScale {
  /// Keeps the factor, and what it multiplies, within a double's range.
  static constexpr int exponent_max = 256;

  std::int32_t exponent = 0;  ///< base 2; -exponent_max to exponent_max

  constexpr double factor() const { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52U); }
  constexpr bool operator==(const FilmScale&) const = default;
};

/// RGB sums of scaled light in units of 2^-32. A sum reaches 2^31 before it saturates: 2^15 samples of 2^16, all of a pixel, if
/// its planes are gathered. Deposits are not negative, so a saturating sum does not depend on the order either.
struct FixedColor {
  std::array<std::int64_t, 3> channel{};
  /// Written out, since a defaulted one calls memcmp().
  constexpr bool operator==(const FixedColor& other) const {
    const auto& [red, green, blue] = channel;
    return ((red ^ other.channel[0]) | (green ^ other.channel[1]) | (blue ^ other.channel[2])) == 0;
  }
};
inline constexpr double film_resolution = 1.0 / 4294967296.0;

/// Where a channel saturates.
inline constexpr std::int64_t film_channel_max = std::numeric_limits<std::int64_t>::max();

/// Scales and rounds a deposit once, at its origin. Negative or NaN channels deposit 0, too large ones saturate.
FixedColor to_fixed(const Color& light, FilmScale scale = {});
/// Adds, saturating; returns whether a channel saturated.
bool add(FixedColor& sum, const FixedColor& deposit);

/// Samples come in blocks, each as long as all before it: 0, 1, 2 and 3, 4 to 7. Blocks alternate between two planes, so that the
/// light of a block that doubles a pixel's samples is kept apart from what was there before, and from the next block.
constexpr std::uint32_t plane_of(std::uint32_t sample) { return static_cast<std::uint32_t>(std::bit_width(sample)) % 2; }
/// How many of a pixel's first `samples` samples fall on a plane.
constexpr std::uint32_t samples_on(std::uint32_t plane, std::uint32_t samples) {
  std::uint32_t sum = 0;
  for (std::uint32_t first = 0, end = 1; first < samples; first = end, end *= 2) {
    sum += plane_of(first) == plane ? std::min(end, samples) - first : 0;
  }
  return sum;
}

/// The number of planes with light where no pixel has more than `samples` samples.
constexpr std::uint32_t planes_for(std::uint32_t samples) { return samples <= 1 ? 1 : 2; }

/// A pixel's sums, by plane.
struct PixelSums {
  std::array<FixedColor, 2> plane;
  constexpr bool operator==(const PixelSums&) const = default;
};
static_assert(sizeof(PixelSums) == 48);

/// All pixels, row by row from the top left. Not thread-safe; owned by the host.
class Film {
 public:
  /// `planes`: 1 or 2, each of 24 bytes a pixel: planes_for() the samples that a pixel may have in the end.
  Film(int width, int height, FilmScale scale = {}, std::uint32_t planes = 2);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixel_count() const { return first_.size(); }
  /// The scale of all deposits.
  FilmScale scale() const { return scale_; }
  /// The least radiance above 0 that a deposit can have.
  double step() const { return film_resolution / scale_.factor(); }
  /// Adds a node's sums of one pixel; returns whether a channel saturated. Requires pixel < pixel_count(), and no light on a
  /// plane that the film does not have.
  bool deposit(std::uint32_t pixel, const PixelSums& sums);
  /// The sums of a pixel: 0 on a plane that does not exist. Requires pixel < pixel_count().
  PixelSums sums(std::uint32_t pixel) const { return {{first_[pixel], has_second() ? second_[pixel] : FixedColor{}}}; }
  /// Adds `count` to the number of samples of a pixel's deposits.
  void add_samples(std::uint32_t pixel, std::uint32_t count) {
    own_samples_[pixel] += count;
    has_own_samples_ = true;
  }
  /// add_samples() for every pixel.
  void add_samples_to_all(std::uint32_t count) { samples_of_all_ += count; }
  std::uint32_t samples(std::uint32_t pixel) const { return samples_of_all_ + (has_own_samples_ ? own_samples_[pixel] : 0); }
  /// The number of samples of all pixels.
  std::uint64_t samples() const;
  /// Mean linear radiance of a pixel; requires samples(pixel) > 0.
  Vec3d radiance(std::uint32_t pixel) const { return scaled_mean(pixel) * (1 / scale_.factor()); }
  /// The radiance of pixels from `first` on, as floats, three for each.
  void copy_radiance(std::size_t first, std::span<float> rgb) const;
  /// Mean linear scaled radiance of a pixel; requires samples(pixel) > 0.
  Vec3d scaled_mean(std::uint32_t pixel) const;
  /// Scaled light of a pixel on a plane.
  Vec3d scaled_sum(std::uint32_t pixel, std::uint32_t plane) const;
  /// Moves a pixel's light to the plane of its last sample: the other plane is free for the next block. Returns whether a channel
  /// saturated. Requires samples(pixel) > 0.
  bool gather_planes(std::uint32_t pixel);
  /// FNV-1a over the sums, the size and the scale, if that is not 1: equal pictures, equal hashes.
  std::uint64_t hash() const;

 private:
  bool has_second() const { return second_.size() > 0; }

  int width_, height_;
  FilmScale scale_;
  std::uint32_t samples_of_all_ = 0;
  bool has_own_samples_ = false;
  ZeroedArray<std::uint32_t> own_samples_;  ///< beyond those of all pixels: untouched memory where pixels have no more
  ZeroedArray<FixedColor> first_, second_;  ///< planes; the second may be empty
};

struct FilmRange {
  std::uint64_t pixels_cut = 0;  ///< pixels with a saturated channel
  double cut_from = 0;           ///< the least radiance of such a channel, which is too small; 0: none is saturated
  double brightest = 0;          ///< the largest radiance of a channel
};

/// The range of a film whose pixels all have samples.
FilmRange range_of(const Film& film);

}  // namespace dmpc::core
