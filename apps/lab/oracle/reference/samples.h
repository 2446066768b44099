// Positions of a pixel's samples.
#pragma once

#include <cstdint>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/picture/sampling/sample_pair.h"

namespace dmpc::apps {

/// Offsets from the pixel's centre, in pixels, -1/2 to 1/2.
struct SamplePosition {
  double column = 0, row = 0;
};

/// A rule for the positions of each pixel's samples; a pure function of pixel and sample.
class SamplePattern {
 public:
  /// Sample positions of core/picture/camera/camera.h, for a comparison sample by sample: the centre for one sample, else the
  /// product's jitter.
  static SamplePattern of_product(std::uint32_t samples) { return {samples, 1, 0, Kind::product}; }
  /// One sample at a random position in each cell of a lattice over the pixel; another seed gives other positions.
  static SamplePattern stratified(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed) {
    return {columns, rows, seed, Kind::stratified};
  }

  std::uint32_t count() const { return columns_ * rows_; }
  SamplePosition position(std::uint32_t pixel, std::uint32_t sample) const {
    if (kind_ == Kind::stratified) {
      return {(sample % columns_ + random(pixel, sample, 0)) / columns_ - 0.5,
              (sample / columns_ + random(pixel, sample, 1)) / rows_ - 0.5};
    }
    const core::SamplePosition position = count() == 1 ? core::SamplePosition{0.5, 0.5} : core::sample_position(pixel, sample);
    return {position.x - 0.5, position.y - 0.5};
  }

 private:
  enum class Kind : std::uint8_t { product, stratified };

  SamplePattern(std::uint32_t columns, std::uint32_t rows, std::uint64_t seed, Kind kind)
      : columns_(columns), rows_(rows), seed_(seed), kind_(kind) {
    core::expect(columns > 0 && rows > 0, "a pixel has samples");
  }

  /// Returns a number uniform in [0, 1), independent of the product's.
  double random(std::uint32_t pixel, std::uint32_t sample, std::uint64_t dimension) const {
    const std::uint64_t place = core::mix((std::uint64_t{pixel} << 32U | sample) ^ core::mix(seed_ + 0x5851f42d4c957f2dULL));
    return static_cast<double>(core::mix(place + 2 * dimension + 1) >> 11U) * 0x1p-53;
  }

  std::uint32_t columns_, rows_;
  std::uint64_t seed_;
  Kind kind_;
};

}  // namespace dmpc::apps
