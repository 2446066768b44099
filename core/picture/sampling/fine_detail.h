// Which pixels of a picture show what is finer than a pixel: found on the host, from the scene, before anything is rendered.
#pragma once

#include <cstdint>
#include <vector>

#include "core/database/database.h"
#include "core/picture/camera/camera.h"

namespace dmpc::core {

/// What is seen directly and is thinner than a pixel, by pixel: how much of the pixel it would cover if nothing lay before it.
/// Few samples of such a pixel meet it, so that they may all agree by chance. Shadows and mirrored things are not in it, nor what
/// crowds: a pixel that small things fill looks uneven to any few samples. Immutable once found.
class FineDetail {
 public:
  /// Knows of no detail.
  FineDetail() = default;

  bool is_empty() const { return pixels_.empty(); }
  /// Something isolated and fine is in the pixel.
  bool has(std::uint32_t pixel) const;
  /// Requires has(pixel): of the pixel, what one of its primitives covers, by the mean over all that they cover.
  double coverage(std::uint32_t pixel) const { return double{1} * pixels_[pixel].squares / pixels_[pixel].areas; }
  /// Requires has(pixel): the mean of the square of coverage times the pixel's number of primitives.
  double squares(std::uint32_t pixel) const { return pixels_[pixel].squares * unit; }
  /// Requires has(pixel): the variance of a sample that meets a primitive, which has light 1 before light 0, or does not.
  double variance(std::uint32_t pixel) const { return pixels_[pixel].areas * unit - squares(pixel); }
  /// The square of the difference in light that is expected of them as long as none was met.
  double contrast() const { return contrast_; }

 private:
  friend class FineDetailFinder;

  /// Sums over primitives, in units: whole numbers, whose order does not matter.
  struct Cover {
    std::uint32_t areas = 0, squares = 0;
  };
  static constexpr double unit = 0x1p-28;

  std::vector<Cover> pixels_;  ///< empty: none has any
  double contrast_ = 0;
};

/// Projects the primitives of the database, whose bytes it reads. Takes the time of some primitives for each pixel that a thin
/// one crosses. Thread safety: pure.
FineDetail find_fine_detail(const Database& database, const Camera& camera);

}  // namespace dmpc::core
