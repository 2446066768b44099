#include "core/picture/camera/camera.h"

#include <algorithm>

#include "core/base/elementary.h"
#include "core/base/expect.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/scene/frame.h"

namespace dmpc::core {
Camera::Camera(const View& view, const GridFrame& frame, int width, int height, int samples)
    : width_(width), height_(height), samples_(samples) {
  expect(width > 0 && height > 0 && samples > 0, "a camera has pixels and samples");
  eye_ = to_local(frame, view.from);
  const Vec3d low = frame.low, extent = length(frame.eye_extent) > 0 ? frame.eye_extent : grid_high(frame) - low;
  middle_ = low + extent * 0.5;
  reach_ = length(eye_ - middle_) > far_eye_diagonals * length(extent) ? length(extent) : 0;
  const std::array<Vec3d, 3> screen = screen_axes(view);
  const Vec3d right = screen[0], up = screen[1];
  forward_ = -screen[2];
  // A picture one pixel wide has no pixel spacing; its pixel spans the whole angle.
  const int intervals = std::max(1, std::min(width, height) - 1);
  const double pixel = 2.0 * tan_degrees(view.angle_degrees / 2) / intervals;
  right_ = right * pixel;
  down_ = up * -pixel;
}

/// A lower bound of t for hits: the ray's nearest point to the middle, less a diagonal of the grid.
double Camera::start_of(const Vec3d& towards) const {
  return reach_ > 0 ? std::max(0.0, dot(middle_ - eye_, towards) - reach_) : 0.0;
}

double Camera::square_cosine(std::uint32_t pixel) const {
  const PixelPlace place = place_of(pixel);
  const Vec3d towards = forward_ + right_ * place.column + down_ * place.row;
  return 1.0 / dot(towards, towards);
}

Camera::PixelPlace Camera::place_of(std::uint32_t pixel) const {
  return {static_cast<double>(pixel % static_cast<std::uint32_t>(width_)) - 0.5 * (width_ - 1),
          static_cast<double>(pixel / static_cast<std::uint32_t>(width_)) - 0.5 * (height_ - 1)};
}

Ray Camera::primary_ray(std::uint32_t pixel, std::uint32_t sample) const {
  auto [column, row] = place_of(pixel);
  if (samples_ > 1) {
    const SamplePosition position = sample_position(pixel, sample);
    column += position.x - 0.5;
    row += position.y - 0.5;
  }
  Ray ray;
  const Vec3d towards = normalize(forward_ + right_ * column + down_ * row);
  const double start = start_of(towards);
  ray.start_at(eye_ + towards * start);
  ray.cone = cone_bits(start);
  ray.go_along(towards);
  ray.pixel = pixel;
  ray.sample = static_cast<std::uint16_t>(sample);
  return ray;
}

Vec3d Camera::on_film(const Vec3d& offset) const {
  const double depth = dot(offset, forward_);
  return {dot(offset, right_) / dot(right_, right_) + 0.5 * (width_ - 1) * depth,
          dot(offset, down_) / dot(down_, down_) + 0.5 * (height_ - 1) * depth, depth};
}

}  // namespace dmpc::core
