#include "core/picture/camera/tile_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmpc::core {
namespace {

/// The maximum angle, in radians, by which rounding may turn a ray: each component of a direction is rounded by at most 2^-25,
/// and the planes of boxes appear to a ray off by less than 2^-22 of their distance (core/trace/kernel.h), together sqrt(3)
/// (2^-25 + 2^-22). The rounding of doubles here is negligible beside it.
constexpr double turn_radians = 0x1p-21;
/// The maximum film radius, in units of its distance from the eye, such that a turned ray still points ahead.
constexpr double film_radius_max = 0x1p12;
/// From the middle of a pixel to a sample, and one pixel more.
constexpr double sample_margin_pixels = 0.5 + 1.0;

/// More than half of the film's diagonal.
double film_radius(const Camera& camera) {
  return camera.pixel_size() * (0.5 * (camera.width() + camera.height()) + 2 * sample_margin_pixels);
}

/// At a distance r from the middle of a film at distance 1, a ray turned by e arrives e (1 + r^2) / (1 - e r) farther off, since
/// tan(a + e) - tan(a) = tan(e) (1 + tan(a)^2) / (1 - tan(a) tan(e)); 1 - e r is more than 1/2.
double margin_pixels_of(const Camera& camera) {
  const double radius = film_radius(camera);
  return sample_margin_pixels + 2 * turn_radians * (1 + radius * radius) / camera.pixel_size();
}

/// The point at depth 0 between a point ahead of the eye and one that is not.
Vec3d at_depth_0(const Vec3d& a, const Vec3d& b) {
  const double share = a.z / (a.z - b.z);
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, 0};
}

constexpr std::uint64_t bits_between(std::uint32_t first, std::uint32_t last) {
  return (~std::uint64_t{0} << first) & (~std::uint64_t{0} >> (63 - last));
}

}  // namespace

BoxProjector::Side::Side(int pixels, double margin_pixels)
    : pixels_(pixels), margin_pixels_(margin_pixels), tiled_(TiledSide::of(pixels)) {
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const std::uint32_t tile = tiled_.tile_of(static_cast<std::uint32_t>(pixel));
    first_[tile] = (tiles_ >> tile & 1U) != 0 ? first_[tile] : pixel - margin_pixels;
    last_[tile] = pixel + margin_pixels;
    tiles_ |= std::uint64_t{1} << tile;
  }
}

/// The box is seen between its outermost corners.
std::uint64_t BoxProjector::Side::footprint_of_whole(const Proxy& proxy, std::size_t axis) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < proxy.count; ++i) {
    const double at = proxy.corners[i][axis] / proxy.corners[i].z;
    low = std::min(low, at);
    high = std::max(high, at);
  }
  low = std::max(std::ceil(low - margin_pixels_), 0.0);
  high = std::min(std::floor(high + margin_pixels_), pixels_ - 1.0);
  const auto tile_at = [&](double pixel) { return tiled_.tile_of(static_cast<std::uint32_t>(pixel)); };
  return low <= high ? bits_between(tile_at(low), tile_at(high)) : 0;
}

/// Corners at depth 0 are not visible: a tile sees nothing if all corners lie beyond the plane through the eye and one of the
/// tile's edges.
std::uint64_t BoxProjector::Side::footprint_of_cut(const Proxy& proxy, std::size_t axis) const {
  std::uint64_t footprint = 0;
  for (std::uint32_t tile = 0; tile < tiles_per_side; ++tile) {
    bool is_before = true, is_behind = true;
    for (std::size_t i = 0; i < proxy.count; ++i) {
      const Vec3d& corner = proxy.corners[i];
      is_before = is_before && corner[axis] < first_[tile] * corner.z;
      is_behind = is_behind && corner[axis] > last_[tile] * corner.z;
    }
    footprint |= std::uint64_t{!is_before && !is_behind} << tile;
  }
  return footprint & tiles_;
}

BoxProjector::BoxProjector(const Camera& camera)
    : eye_(camera.eye()),
      axes_{camera.on_film({1, 0, 0}), camera.on_film({0, 1, 0}), camera.on_film({0, 0, 1})},
      across_(camera.width(), margin_pixels_of(camera)),
      down_(camera.height(), margin_pixels_of(camera)),
      is_certain_(film_radius(camera) <= film_radius_max && is_finite(eye_) && is_finite(axes_[0] + axes_[1] + axes_[2])) {}

BoxProjector::Proxy BoxProjector::proxy_of(const Box& box) const {
  const Vec3d low = box.low - eye_, high = box.high - eye_;
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = axes_[0] * ((i & 1U) != 0 ? high.x : low.x) + axes_[1] * ((i & 2U) != 0 ? high.y : low.y) +
                 axes_[2] * ((i & 4U) != 0 ? high.z : low.z);
  }
  Proxy proxy;
  for (const Vec3d& corner : corners) {
    if (corner.z > 0) {
      proxy.add(corner);
    }
  }
  proxy.is_cut = proxy.count < corners.size();
  for (std::size_t i = 0; i < corners.size() && proxy.is_cut; ++i) {
    for (const std::size_t neighbour : {i | 1U, i | 2U, i | 4U}) {
      if ((corners[i].z > 0) != (corners[neighbour].z > 0)) {
        proxy.add(at_depth_0(corners[i], corners[neighbour]));
      }
    }
  }
  return proxy;
}

TileFootprint BoxProjector::footprint_of(const Box& box) const {
  const Proxy proxy = proxy_of(box);
  return proxy.count == 0 ? TileFootprint{} : TileFootprint{across_.footprint_of(proxy, 0), down_.footprint_of(proxy, 1)};
}

}  // namespace dmpc::core
