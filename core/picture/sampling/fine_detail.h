// The pixels of a picture with details finer than a pixel: found on the host, from the scene, before rendering.
#pragma once

#include <cstdint>
#include <vector>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"

namespace dmpc::core {

/// For each pixel, the directly visible primitives that are thinner than a pixel: how much of the pixel each would cover if
/// nothing hid it. Few samples of such a pixel hit it, so that they may all agree by chance. Shadows and reflections are not
/// included, nor crowds: a pixel that small primitives fill looks uneven to any few samples. Immutable.
class FineDetail {
 public:
  /// Knows of no detail.
  FineDetail() = default;

  bool is_empty() const { return pixels_.empty(); }
  /// Whether an isolated and fine primitive is in the pixel.
  bool has(std::uint32_t pixel) const;
  /// Requires has(pixel): the share of the pixel that one of its primitives covers, as the area-weighted mean.
  double coverage(std::uint32_t pixel) const { return double{1} * pixels_[pixel].squares / pixels_[pixel].areas; }
  /// Requires has(pixel): the mean of the square of coverage times the pixel's number of primitives.
  double squares(std::uint32_t pixel) const { return pixels_[pixel].squares * unit; }
  /// Requires has(pixel): the variance of a sample that hits a primitive of light 1 before light 0, or does not.
  double variance(std::uint32_t pixel) const { return pixels_[pixel].areas * unit - squares(pixel); }
  /// The squared difference in light that is expected as long as none was hit.
  double contrast() const { return contrast_; }

 private:
  friend class FineDetailFinder;

  /// Sums over primitives, in units: integers, so that the order does not matter.
  struct Cover {
    std::uint32_t areas = 0, squares = 0;
  };
  static constexpr double unit = 0x1p-28;

  std::vector<Cover> pixels_;  ///< empty: no pixel has any
  double contrast_ = 0;
};

/// Projects the primitives of the database, whose bytes it reads. Takes as long as testing some primitives for each pixel that a
/// thin one crosses. Thread safety: pure.
FineDetail find_fine_detail(const Database& database, const Camera& camera);

}  // namespace dmpc::core
