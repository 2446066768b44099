#include "core/picture/film/rounding_loss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/database/tree/overlap.h"
#include "core/picture/hits/hit_geometry.h"
#include "core/record/coordinate.h"

namespace dmpc::core {
namespace {

/// Half a unit in the last place of a float, relative to its value; a 256th of that for a float with a rest.
constexpr double float_rounding = 0x1p-24, rest_rounding = 0x1p-32;
/// Rounding of the position and the radius of a surface that passes by local zero.
constexpr double passing_rounding = 0x1p-28, passing_radius_rounding = 0x1p-44;
/// At most a unit in the last place of a hit's t, relative to its value.
constexpr double tie_rounding = 0x1p-23;
/// The least distance of the eye from a curved surface, as a share of its radius, and if the surface passes by local zero.
constexpr double curve_nearest = 0x1p-20, passing_nearest = 0x1p-36;
/// The maximum number of a polygon's triangles for which inner edges are searched.
constexpr std::size_t polygon_triangles_max = 64;

/// The maximum rounding error of each coordinate.
Vec3d rounding_of(const Vec3d& point) {
  const auto along = [](double value) { return std::max(float_rounding * std::fabs(value), coordinate_step / 2); };
  return {along(point.x), along(point.y), along(point.z)};
}

double distance_to(const Box& box, const Vec3d& point) {
  Vec3d gap;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    gap[axis] = std::max({box.low[axis] - point[axis], point[axis] - box.high[axis], 0.0});
  }
  return length(gap);
}

double largest_coordinate(const Box& box) { return std::max(largest_component(box.low), largest_component(box.high)); }

struct Triangle {
  explicit Triangle(const PrimitiveValues& values) : corner{values.vector(0), values.vector(3), values.vector(6)} {}

  std::array<Vec3d, 3> corner;
};

/// The parameter of the point of [a, b] nearest to `point`: 0 at a, 1 at b.
double nearest_place(const Vec3d& a, const Vec3d& b, const Vec3d& point) {
  return std::clamp(dot(point - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
}

/// The distance from the eye to the nearest point of a triangle.
double distance_to(const Triangle& triangle, const Vec3d& eye) {
  const auto& [a, b, c] = triangle.corner;
  const Vec3d normal = normalize(cross(b - a, c - a));
  double beside = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d from = triangle.corner[k], to = triangle.corner[(k + 1) % 3];
    if (dot(cross(to - from, eye - from), normal) < 0) {
      beside = std::min(beside, length(from + (to - from) * nearest_place(from, to, eye) - eye));
    }
  }
  return std::isinf(beside) ? std::fabs(dot(eye - a, normal)) : beside;
}

/// The distance from a point to the lateral surface.
double distance_to_cone(const CurvedValues& cone, const Vec3d& point) {
  const Vec3d axis = cone.axis(), from_base = point - cone.vector(0);
  const double height = length(axis), up = dot(from_base, axis) / height, off = length(from_base - axis * (up / height));
  const Vec3d at{up, off, 0}, low{0, std::fabs(cone.value(3)), 0}, high{height, std::fabs(cone.value(7)), 0};
  return length(low + (high - low) * nearest_place(low, high, at) - at);
}

double distance_to_curved(const PrimitiveValues& primitive, const Vec3d& point) {
  const CurvedValues curved = primitive.curved();
  return primitive.kind == PrimitiveKind::cone ? distance_to_cone(curved, point)
                                               : std::fabs(length(point - curved.vector(0)) - std::fabs(curved.value(3)));
}

double widest(const PrimitiveValues& curved) {
  const double radius = std::fabs(double{curved.value[3]});
  return curved.kind == PrimitiveKind::cone ? std::max(radius, std::fabs(double{curved.value[7]})) : radius;
}

class LossFinder {
 public:
  LossFinder(const Database& database, const Camera& camera) : database_(database), camera_(camera) {}

  RoundingLoss find() {
    count_collapsed();
    count_swapped();
    const GridFrame& frame = database_.header().frame;
    if (may_matter({frame.low, grid_high(frame)})) {
      for (std::size_t id = 0; id < database_.primitives().size(); ++id) {
        count(id);
      }
    }
    return loss_;
  }

 private:
  /// The size in pixels of a length at a distance.
  double pixels(double length, double distance) const { return length / (distance * camera_.pixel_size()); }

  void count_collapsed() {
    loss_.collapsed = database_.collapsed().size();
    for (const CollapsedPrimitive& one : database_.collapsed()) {
      const Vec3d offset = Vec3d(one.place) - camera_.eye();
      if (camera_.on_film(offset).z > 0) {
        loss_.collapsed_pixels = std::max(loss_.collapsed_pixels, pixels(double{one.size}, length(offset)));
      }
    }
  }

  /// Intersecting faces of two planes are swapped where their distance is less than the resolution of t.
  void count_swapped() {
    for (const CloseFaces& faces : database_.close_faces()) {
      const Vec3d offset = Vec3d(faces.place) - camera_.eye();
      const double distance = length(offset), tie = tie_rounding * distance * (1.0 + faces.layers);
      const double least{faces.least}, most{faces.most};
      const double share = tie >= most ? 1.0 : tie > least ? (tie - least) / (most - least) : 0.0;
      const double across = share * pixels(double{faces.size}, distance);
      if (camera_.on_film(offset).z > 0 && across > rounding_allowed_pixels) {
        ++loss_.swapped;
        loss_.swapped_pixels = std::max(loss_.swapped_pixels, across);
      }
    }
  }

  /// Whether rounding may move something in a box by more than is allowed.
  bool may_matter(const Box& box) const {
    return pixels(2 * float_rounding * largest_coordinate(box), distance_to(box, camera_.eye())) > rounding_allowed_pixels;
  }

  void count(std::size_t id) {
    const PrimitiveValues& primitive = database_.primitives()[id];
    const Box box = bounds_of(primitive);
    if (!may_matter(box)) {
      return;
    }
    const double moved = primitive.kind == PrimitiveKind::triangle ? moved_triangle(id) : moved_curved(primitive, box);
    loss_.moved += moved > rounding_allowed_pixels ? 1 : 0;
    loss_.moved_pixels = std::max(loss_.moved_pixels, moved > rounding_allowed_pixels ? moved : 0.0);
  }

  /// In pixels, nearest to the eye: the displacement by rounding, and the offset of ray starts, within which rays see nothing.
  double moved_curved(const PrimitiveValues& curved, const Box& box) const {
    const double size = 2 * largest_coordinate(box), radius = widest(curved),
                 distance = distance_to_curved(curved, camera_.eye());
    if (!curved.curved().passes_by()) {
      return pixels((3 * rest_rounding + curved_going_on) * size, std::max(distance, curve_nearest * radius));
    }
    const double nearest = std::max(distance, passing_nearest * radius);
    const double turned = 2 * passing_rounding * (largest_component(camera_.eye()) + nearest);
    return pixels((passing_clearance + passing_radius_rounding) * size + turned, nearest);
  }

  /// In pixels: displacements of its plane where it is nearest, of its corners, and of its edges where nearest to the eye.
  double moved_triangle(std::size_t id) const {
    const Triangle triangle(database_.primitives()[id]);
    if (is_beside_film(triangle)) {
      return 0;
    }
    const double nearest = distance_to(triangle, camera_.eye());
    double moved = nearest > 0 ? pixels(moved_plane(triangle), nearest) : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d& corner = triangle.corner[k];
      if (is_on_film(corner)) {
        moved = std::max(moved, pixels(length(rounding_of(corner)), length(corner - camera_.eye())));
      }
      const double edge = moved_edge(corner, triangle.corner[(k + 1) % 3]);
      if (edge > std::max(moved, rounding_allowed_pixels) && !is_inner_edge(id, k)) {
        moved = edge;
      }
    }
    return moved;
  }

  static double moved_plane(const Triangle& triangle) {
    const auto& [a, b, c] = triangle.corner;
    const Vec3d normal = normalize(cross(b - a, c - a));
    double moved = 0;
    for (const Vec3d& corner : triangle.corner) {
      moved = std::max(moved, dot_of_magnitudes(normal, rounding_of(corner)));
    }
    return moved;
  }

  /// The displacement perpendicular to the edge.
  double moved_edge(const Vec3d& from, const Vec3d& to) const {
    const Vec3d along = normalize(to - from);
    const double place = nearest_place(from, to, camera_.eye());
    const Vec3d nearest = from + (to - from) * place;
    if (!is_on_film(nearest)) {
      return 0;
    }
    const Vec3d rounding = rounding_of(from) * (1 - place) + rounding_of(to) * place;
    Vec3d across;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      across[axis] = rounding[axis] * std::sqrt(std::max(1 - along[axis] * along[axis], 0.0));
    }
    return pixels(length(across), length(nearest - camera_.eye()));
  }

  /// Whether another triangle of the same polygon has the edge that begins at corner k, which is then invisible.
  bool is_inner_edge(std::size_t id, std::size_t k) const {
    const auto sources = database_.sources();
    const Triangle triangle(database_.primitives()[id]);
    const Vec3d &a = triangle.corner[k], &b = triangle.corner[(k + 1) % 3];
    const auto has_it = [&](std::size_t other) {
      const auto corner = Triangle(database_.primitives()[other]).corner;
      return std::find(corner.begin(), corner.end(), a) != corner.end() &&
             std::find(corner.begin(), corner.end(), b) != corner.end();
    };
    const std::size_t first = id > polygon_triangles_max ? id - polygon_triangles_max : 0;
    const std::size_t end = std::min(id + polygon_triangles_max, sources.size());
    for (std::size_t other = first; other < end; ++other) {
      if (other != id && sources[other].object == sources[id].object && has_it(other)) {
        return true;
      }
    }
    return false;
  }

  bool is_on_film(const Vec3d& point) const {
    const Vec3d place = camera_.on_film(point - camera_.eye());
    return place.z > 0 && place.x >= -place.z && place.x <= camera_.width() * place.z && place.y >= -place.z &&
           place.y <= camera_.height() * place.z;
  }

  /// Conservative: all of the triangle lies behind the eye or to one side of the picture.
  bool is_beside_film(const Triangle& triangle) const {
    std::array<bool, 5> all{true, true, true, true, true};
    for (const Vec3d& corner : triangle.corner) {
      const Vec3d place = camera_.on_film(corner - camera_.eye());
      const std::array<bool, 5> beyond{place.z <= 0, place.x<-place.z, place.x> camera_.width() * place.z,
                                       place.y<-place.z, place.y> camera_.height() * place.z};
      for (std::size_t side = 0; side < all.size(); ++side) {
        all[side] = all[side] && beyond[side];
      }
    }
    return std::find(all.begin(), all.end(), true) != all.end();
  }

  const Database& database_;
  const Camera& camera_;
  RoundingLoss loss_;
};

}  // namespace

RoundingLoss find_rounding_loss(const Database& database, const Camera& camera) { return LossFinder(database, camera).find(); }

}  // namespace dmpc::core
