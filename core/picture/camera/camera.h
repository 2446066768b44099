// From a pixel and a sample to its primary ray.
#pragma once

#include <cstdint>

#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/scene/scene.h"

namespace dmpc::core {

/// A pinhole camera in grid-local coordinates. NFF's angle spans the centres of the first and last pixel along the shorter side:
/// sample i of n lies at tan(angle/2) (2i/(n-1) - 1), so 513x513 shoots through the corners of 512x512 pixels (Haines' SPD
/// procedure) and 512x512 gives the rays of the article.
class Camera {
 public:
  /// Requires width, height > 0. With one sample a pixel the ray goes through the centre; with more, samples are jittered over
  /// the pixel by a hash of (pixel, sample).
  Camera(const View& view, const GridFrame& frame, int width, int height, int samples);

  Ray primary_ray(std::uint32_t pixel, std::uint32_t sample) const;
  /// Projects an offset from the eye: column and row, integers in the middles of pixels, each times z, the depth along the view
  /// direction, which is negative behind the eye.
  Vec3d on_film(const Vec3d& offset) const;
  const Vec3d& eye() const { return eye_; }
  /// The view direction, of unit length.
  const Vec3d& forward() const { return forward_; }
  /// The squared cosine between forward() and the ray through a pixel's middle. Seen from the eye the pixel is shorter by this
  /// factor, outwards, than one in the middle of the picture; across that it is shorter by the cosine alone.
  double square_cosine(std::uint32_t pixel) const;
  /// The side of a pixel on a film at distance 1.
  double pixel_size() const { return length(right_); }
  int width() const { return width_; }
  int height() const { return height_; }
  std::uint32_t pixel_count() const { return static_cast<std::uint32_t>(width_) * static_cast<std::uint32_t>(height_); }
  int samples() const { return samples_; }
  /// The same with this number of samples.
  Camera with_samples(int samples) const {
    Camera camera = *this;
    camera.samples_ = samples;
    return camera;
  }

 private:
  /// In pixels from the middle of the picture.
  struct PixelPlace {
    double column = 0, row = 0;
  };

  /// The pixel's middle.
  PixelPlace place_of(std::uint32_t pixel) const;
  /// How far from the eye a ray along the unit direction `towards` starts.
  double start_of(const Vec3d& towards) const;

  Vec3d eye_;
  Vec3d middle_;                  ///< the grid's middle
  double reach_ = 0;              ///< distance from there at which rays of a distant eye start; 0: they start at the eye
  Vec3d forward_, right_, down_;  ///< right_ and down_: one pixel's step in the plane at distance 1
  int width_, height_, samples_;
};

}  // namespace dmpc::core
