#include "core/picture/sampling/fine_detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/expect.h"
#include "core/database/tree/leaf_values.h"
#include "core/record/coordinate.h"
#include "core/record/curved_values.h"
#include "core/record/records.h"

namespace dmpc::core {
namespace {

/// The first samples meet details of this width, in pixels.
constexpr double width_max = 1;
/// Where the areas sum up to more, in pixels, or a primitive covers more on average, the first samples meet some of them, too.
constexpr double crowd_min = 0.3, coverage_max = 0.2;
/// Steps per pixel along and across a thin primitive.
constexpr double steps_a_pixel = 4;
/// Geometry nearer to the plane of the eye than this share of its depth is clipped.
constexpr double near_share = 1e-3;
constexpr double quarter_pi = 0.7853981633974483;

/// A point on the film: integers are the middles of pixels.
struct Place {
  double x = 0, y = 0;
};
Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
double length(const Place& a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// A thin primitive as its middle line and its width in pixels at `peak` of the line, from where the width changes linearly to
/// that at the ends.
struct Strip {
  Place from, to;
  double from_width = 0, to_width = 0;
  std::optional<double> peak = std::nullopt;  ///< for a triangle: its apex along the longest side, which is the middle line
  double peak_height = 0;                     ///< signed, to the right of the line; the strip lies between line and apex

  double height(double t) const {
    if (!peak) {
      return from_width + (to_width - from_width) * t;
    }
    return peak_height * (t < *peak ? t / *peak : *peak < 1 ? (1 - t) / (1 - *peak) : 1);
  }
};

/// The part of [0, 1] on which start + step * t lies between low and high.
void clip(double start, double step, double low, double high, double& first, double& last) {
  if (step == 0) {
    last = start >= low && start <= high ? last : -1;
    return;
  }
  const double a = (low - start) / step, b = (high - start) / step;
  first = std::max(first, std::min(a, b));
  last = std::min(last, std::max(a, b));
}

}  // namespace

class FineDetailFinder {
 public:
  FineDetailFinder(const Database& database, const Camera& camera)
      : database_(database), records_(database.bytes()), camera_(camera), eye_(camera.eye()), covers_(camera.pixel_count()) {}

  FineDetail find() {
    database_.header().has_instances != 0 ? look_at_copies() : look_at_records();
    FineDetail detail;
    if (is_any_) {
      detail.pixels_ = std::move(covers_);
      detail.contrast_ = contrast();
    }
    return detail;
  }

 private:
  /// The contrast of the light of all light sources, halved by a diffuse surface.
  double contrast() const {
    Vec3d sum;
    for (std::uint32_t i = 0; i < database_.header().light_count; ++i) {
      const auto light = read<LightRecord>(records_.find(advance(database_.header().lights, i * sizeof(LightRecord))));
      sum = sum + Vec3d(light.intensity);
    }
    return dot(sum, sum) / 12;
  }

  /// The projection of the point, times its depth.
  Vec3d on_film(const Vec3d& point) const { return camera_.on_film(point - eye_); }
  Vec3d on_film(const float* point) const { return on_film(Vec3d{point[0], point[1], point[2]}); }
  static Place place_of(const Vec3d& seen) { return {seen.x / seen.z, seen.y / seen.z}; }
  double pixels_of(double size, double depth) const { return std::fabs(size) / (depth * camera_.pixel_size()); }

  void look_at_records() {
    for (const Database::Place& place : database_.find_places()) {
      if (place.leaf != no_address) {
        look_at(primitive_in(records_.find(place.leaf), place.lane));
      }
    }
  }

  /// The records do not contain the primitives of base meshes.
  void look_at_copies() {
    expect(database_.primitives().size() == database_.header().primitive_count,
           "whoever looks for the detail of base meshes has what is in their places");
    for (const PrimitiveValues& primitive : database_.primitives()) {
      if (primitive.kind != PrimitiveKind::triangle ||
          !leaves_nothing({primitive.vector(0), primitive.vector(3), primitive.vector(6)})) {
        look_at(primitive);
      }
    }
  }

  void look_at(const PrimitiveValues& primitive) {
    switch (primitive.kind) {
      case PrimitiveKind::sphere:
        return look_at_sphere(primitive.value.data());
      case PrimitiveKind::cone:
        return look_at_cone(ConeFloats({primitive.value.data(), 1, 0}));
      case PrimitiveKind::triangle:
        return look_at_triangle(primitive.value.data());
      case PrimitiveKind::instance:
        expect(false, "a box is no detail");
    }
  }

  /// A disc, treated as if spread evenly over its bounding square.
  void look_at_sphere(const float* value) {
    const Vec3d seen = on_film(value);
    const double radius = seen.z > 0 ? pixels_of(value[3], seen.z) : width_max;
    const Place middle = place_of(seen);
    if (!(2 * radius < width_max) ||
        !(middle.x > -1 && middle.x < camera_.width() && middle.y > -1 && middle.y < camera_.height())) {
      return;
    }
    const int columns[] = {static_cast<int>(std::floor(middle.x - radius + 0.5)),
                           static_cast<int>(std::floor(middle.x + radius + 0.5))};
    const int rows[] = {static_cast<int>(std::floor(middle.y - radius + 0.5)),
                        static_cast<int>(std::floor(middle.y + radius + 0.5))};
    for (int row = rows[0]; row <= rows[1]; ++row) {
      for (int column = columns[0]; column <= columns[1]; ++column) {
        const double across = std::min(middle.x + radius, column + 0.5) - std::max(middle.x - radius, column - 0.5);
        const double down = std::min(middle.y + radius, row + 0.5) - std::max(middle.y - radius, row - 0.5);
        cover(column, row, across * down * quarter_pi);
      }
    }
    end_primitive();
  }

  /// A flat cone is neither a strip nor thin.
  void look_at_cone(const ConeFloats& cone) {
    if (cone.is_flat) {
      return;
    }
    std::array<Vec3d, 2> seen{on_film(cone.base), on_film(cone.apex)};
    std::array<double, 2> radius{cone.base_radius, cone.apex_radius};
    const double nearest = near_share * std::max(seen[0].z, seen[1].z);
    if (!(nearest > 0)) {
      return;
    }
    for (std::size_t end = 0; end < 2; ++end) {
      if (seen[end].z < nearest) {
        const double t = (nearest - seen[end].z) / (seen[1 - end].z - seen[end].z);
        seen[end] = seen[end] + (seen[1 - end] - seen[end]) * t;
        radius[end] += (radius[1 - end] - radius[end]) * t;
      }
    }
    look_at_strip(
        {place_of(seen[0]), place_of(seen[1]), 2 * pixels_of(radius[0], seen[0].z), 2 * pixels_of(radius[1], seen[1].z)});
  }

  /// A strip on the triangle's longest side. A triangle that reaches behind the eye is ignored: it is not small.
  void look_at_triangle(const float* value) {
    std::array<Place, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d seen = on_film(value + 3 * i);
      if (!(seen.z > 0)) {
        return;
      }
      corner[i] = place_of(seen);
    }
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      longest = length(corner[(i + 1) % 3] - corner[i]) > length(corner[(longest + 1) % 3] - corner[longest]) ? i : longest;
    }
    const Place side = corner[(longest + 1) % 3] - corner[longest], apex = corner[(longest + 2) % 3] - corner[longest];
    const double side_length = length(side);
    if (side_length > 0) {
      const double height = (side.x * apex.y - side.y * apex.x) / side_length;
      const double peak = (side.x * apex.x + side.y * apex.y) / (side_length * side_length);
      look_at_strip(
          {.from = corner[longest], .to = corner[(longest + 1) % 3], .peak = std::clamp(peak, 0.0, 1.0), .peak_height = height});
    }
  }

  /// Goes step by step along the part that lies in the picture and is thin.
  void look_at_strip(const Strip& strip) {
    const Place way = strip.to - strip.from;
    double first = 0, last = 1;
    clip(strip.from.x, way.x, -1, camera_.width(), first, last);
    clip(strip.from.y, way.y, -1, camera_.height(), first, last);
    const double whole = length(way), seen = whole * (last - first);
    const bool is_wide =
        strip.peak ? std::fabs(strip.peak_height) >= width_max : std::min(strip.from_width, strip.to_width) >= width_max;
    if (is_wide || !(seen > 0) || !(whole < 1e12)) {
      return;
    }
    const auto steps = static_cast<int>(std::ceil(seen * steps_a_pixel));
    const Place right{-way.y / whole, way.x / whole};
    for (int i = 0; i < steps; ++i) {
      const double t = first + (last - first) * (i + 0.5) / steps;
      const double height = strip.height(t), width = std::fabs(height);
      if (width < width_max) {
        const Place place{strip.from.x + way.x * t, strip.from.y + way.y * t};
        cover_across(place, right, strip.peak ? height : 0, width, seen / steps);
      }
    }
    end_primitive();
  }

  /// A section of a strip: beside its line up to `height`, or on both sides of it if that is 0.
  void cover_across(const Place& place, const Place& right, double height, double width, double step) {
    const int parts = std::max(1, static_cast<int>(std::ceil(width * steps_a_pixel)));
    for (int part = 0; part < parts; ++part) {
      const double share = (part + 0.5) / parts;
      const double beside = height != 0 ? share * height : (share - 0.5) * width;
      cover(static_cast<int>(std::floor(place.x + right.x * beside + 0.5)),
            static_cast<int>(std::floor(place.y + right.y * beside + 0.5)), width * step / parts);
    }
  }

  /// Notes what the current primitive covers; it returns to a pixel soon or not at all.
  void cover(int column, int row, double area) {
    if (!(area > 0) || column < 0 || row < 0 || column >= camera_.width() || row >= camera_.height()) {
      return;
    }
    const auto pixel = static_cast<std::uint32_t>(row * camera_.width() + column);
    const auto found =
        std::find_if(under_way_.rbegin(), under_way_.rend(), [&](const Part& part) { return part.pixel == pixel; });
    if (found != under_way_.rend()) {
      found->area += area;
      return;
    }
    if (under_way_.size() == parts_max) {
      end_part(under_way_.front());
      under_way_.erase(under_way_.begin());
    }
    under_way_.push_back({pixel, area});
  }

  struct Part {
    std::uint32_t pixel = 0;
    double area = 0;
  };
  static constexpr std::size_t parts_max = 8;

  void end_primitive() {
    for (const Part& part : under_way_) {
      end_part(part);
    }
    under_way_.clear();
  }
  /// Areas above a few pixels count as crowded, whatever their number.
  void end_part(const Part& part) {
    const double area = std::min(part.area, 1.0);
    FineDetail::Cover& cover = covers_[part.pixel];
    if (cover.areas < std::uint32_t{1} << 30U) {
      cover.areas += static_cast<std::uint32_t>(std::ceil(area / FineDetail::unit));
      cover.squares += static_cast<std::uint32_t>(std::ceil(area * area / FineDetail::unit));
      is_any_ = true;
    }
  }

  const Database& database_;
  LocalRecords records_;
  const Camera& camera_;
  Vec3d eye_;
  std::vector<FineDetail::Cover> covers_;
  std::vector<Part> under_way_;
  bool is_any_ = false;
};

bool FineDetail::has(std::uint32_t pixel) const {
  return !pixels_.empty() && pixels_[pixel].areas > 0 && pixels_[pixel].areas * unit < crowd_min &&
         coverage(pixel) < coverage_max;
}

FineDetail find_fine_detail(const Database& database, const Camera& camera) { return FineDetailFinder(database, camera).find(); }

}  // namespace dmpc::core
