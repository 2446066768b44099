// Which samples each pixel gets in a pass over a picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dmpc::core {

/// Consecutive samples of a pixel.
struct SampleRange {
  std::uint32_t first = 0, count = 1;
  constexpr bool operator==(const SampleRange&) const = default;
};

/// A bit for each pixel of a picture.
class PixelMask {
 public:
  explicit PixelMask(std::uint32_t pixel_count, bool all = false);

  bool has(std::uint32_t pixel) const { return (words_[pixel / 64] >> (pixel % 64) & 1U) != 0; }
  void add(std::uint32_t pixel) { words_[pixel / 64] |= std::uint64_t{1} << (pixel % 64); }
  std::uint32_t count() const;
  /// 64 pixels each, the first in the lowest bit. Bits beyond the picture must stay 0.
  std::span<const std::uint64_t> words() const { return words_; }
  std::span<std::uint64_t> words() { return words_; }
  bool operator==(const PixelMask&) const = default;

 private:
  std::vector<std::uint64_t> words_;
};

/// From one level of samples to a higher one: level 0 has no samples, level 1 those of the first pass, and each level above twice
/// as many as the one below. One byte, since a node stores one for each of its pixels.
class SampleStep {
 public:
  static constexpr std::uint32_t level_max = 15;

  constexpr SampleStep() = default;
  /// Requires levels up to level_max.
  constexpr SampleStep(std::uint32_t from, std::uint32_t to) : bits_(static_cast<std::uint8_t>(to << 4U | from)) {}
  static constexpr SampleStep first() { return {0, 1}; }
  static constexpr SampleStep of_bits(std::uint8_t bits) { return {bits & level_max, static_cast<std::uint32_t>(bits >> 4U)}; }

  constexpr std::uint32_t from() const { return bits_ & level_max; }
  constexpr std::uint32_t to() const { return bits_ >> 4U; }
  constexpr std::uint8_t bits() const { return bits_; }
  /// Whether it adds no samples.
  constexpr bool is_none() const { return to() <= from(); }
  /// The samples that it adds, if the first pass has `first_samples`.
  constexpr SampleRange samples(std::uint32_t first_samples) const {
    const std::uint32_t first = samples_at(from(), first_samples);
    return is_none() ? SampleRange{first, 0} : SampleRange{first, samples_at(to(), first_samples) - first};
  }
  static constexpr std::uint32_t samples_at(std::uint32_t level, std::uint32_t first_samples) {
    return level == 0 ? 0 : first_samples << (level - 1);
  }
  constexpr bool operator==(const SampleStep&) const = default;

 private:
  std::uint8_t bits_ = 0;
};
static_assert(sizeof(SampleStep) == 1);

/// The steps of all pixels of a picture; the pixels of the pass are those whose step adds samples.
class Pass {
 public:
  /// The first: every pixel gets `first_samples`.
  Pass(std::uint32_t pixel_count, std::uint32_t first_samples)
      : steps_(pixel_count, SampleStep::first()), first_samples_(first_samples) {}

  bool has(std::uint32_t pixel) const { return !steps_[pixel].is_none(); }
  /// Whether every pixel gets first_samples(), and had none.
  bool is_first() const;
  SampleRange samples(std::uint32_t pixel) const { return steps_[pixel].samples(first_samples_); }
  /// Samples per pixel in the first pass.
  std::uint32_t first_samples() const { return first_samples_; }
  /// Number of pixels of the pass.
  std::uint32_t pixel_count() const;
  /// One past the last sample of any pixel; 0 if there is none.
  std::uint32_t samples_end() const;
  PixelMask pixels() const;
  /// One for each pixel of the picture.
  std::span<const SampleStep> steps() const { return steps_; }
  std::span<SampleStep> steps() { return steps_; }
  bool operator==(const Pass&) const = default;

 private:
  std::vector<SampleStep> steps_;
  std::uint32_t first_samples_;
};

}  // namespace dmpc::core
