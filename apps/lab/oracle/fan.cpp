#include "apps/lab/oracle/fan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using core::PrimitiveValues;
using core::Ray;
using core::Vec3d;
using core::Vec3f;

/// The plane across the ray, seen from its origin.
struct Across {
  explicit Across(const Ray& ray) : origin(ray.origin) {
    const Vec3d forward = normalize(Vec3d(ray.direction));
    const Vec3d helper = std::fabs(forward.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    right = normalize(cross(forward, helper));
    up = cross(right, forward);
  }
  struct Point {
    double x, y;
  };
  Point operator()(const Vec3f& at) const {
    const Vec3d seen = Vec3d(at) - origin;
    return {dot(seen, right), dot(seen, up)};
  }
  Vec3d origin, right, up;
};

double turn(const Across::Point& a, const Across::Point& b) { return a.x * b.y - a.y * b.x; }
Across::Point from(const Across::Point& a, const Across::Point& b) { return {b.x - a.x, b.y - a.y}; }
double size(const Across::Point& a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// Distance of the ray from the segment between a and b.
double distance(const Across::Point& a, const Across::Point& b) {
  const Across::Point along = from(a, b);
  const double squared = along.x * along.x + along.y * along.y;
  const double share = squared > 0 ? std::clamp(-(a.x * along.x + a.y * along.y) / squared, 0.0, 1.0) : 0.0;
  return size({a.x + along.x * share, a.y + along.y * share});
}

std::array<Vec3f, 3> vertices(const PrimitiveValues& values) {
  const auto& v = values.value;
  return {Vec3f{v[0], v[1], v[2]}, Vec3f{v[3], v[4], v[5]}, Vec3f{v[6], v[7], v[8]}};
}

/// Vertex and edge k of a triangle, where edge k runs from vertex k to vertex k + 1; at most one of them is set.
struct Feature {
  std::optional<std::size_t> vertex, edge;
};

/// Returns how far float rounding may move a ray beside a triangle: the shear moves a vertex by less than 7, the edge function by
/// less than 1 rounding of the reach (exact_intersection.cpp).
double rounding_of(const Ray& ray, const std::array<Vec3f, 3>& corner) {
  const double reach = core::max_over(corner, double{0}, [&](const Vec3f& at) { return length(Vec3d(at) - Vec3d(ray.origin)); });
  return 8 * 0x1p-24 * reach;
}

Feature feature_near(const std::array<Vec3f, 3>& corner, const Across& across, double near) {
  Feature feature;
  std::size_t vertex_count = 0, edge_count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (size(across(corner[k])) <= near) {
      feature.vertex = k;
      ++vertex_count;
    }
    if (distance(across(corner[k]), across(corner[(k + 1) % 3])) <= near) {
      feature.edge = k;
      ++edge_count;
    }
  }
  if (vertex_count != 1) {
    feature.vertex.reset();
  }
  if (vertex_count != 0 || edge_count != 1) {
    feature.edge.reset();
  }
  return feature;
}

/// The directions that a triangle covers around one of its vertices: `extent` radians from `first` on.
struct Sector {
  double first, extent;
};

/// Returns whether the sectors leave no gap in the full circle. Neighbours share their bounding directions bit for bit.
bool cover_circle(std::vector<Sector> sectors) {
  constexpr double slack = 1e-12;
  std::sort(sectors.begin(), sectors.end(), [](const Sector& a, const Sector& b) { return a.first < b.first; });
  if (sectors.empty()) {
    return false;
  }
  const double start = sectors.front().first;
  double covered = start;
  for (const Sector& sector : sectors) {
    if (sector.first > covered + slack) {
      return false;
    }
    covered = std::max(covered, sector.first + sector.extent);
  }
  return covered >= start + 2 * std::numbers::pi - slack;
}

Sector sector_of(const Across::Point& a, const Across::Point& b) {
  const double angle_a = std::atan2(a.y, a.x), angle_b = std::atan2(b.y, b.x);
  const double first = turn(a, b) >= 0 ? angle_a : angle_b, last = turn(a, b) >= 0 ? angle_b : angle_a;
  const double extent = last >= first ? last - first : last - first + 2 * std::numbers::pi;
  // A triangle covers less than half a circle. One seen edge-on covers nothing, though rounding of the two angles may give a full
  // circle.
  return {first, extent < 1.5 * std::numbers::pi ? extent : 0};
}

/// Returns whether the ray is within `near` of the segment between a and b.
bool passes(const Across& across, const Vec3f& a, const Vec3f& b, double near) { return distance(across(a), across(b)) <= near; }

std::vector<std::uint32_t> around_vertex(std::span<const PrimitiveValues> primitives, const Vec3f& vertex, const Across& across,
                                         double near) {
  std::vector<std::uint32_t> fan;
  std::vector<Sector> sectors;
  for (std::uint32_t id = 0; id < primitives.size(); ++id) {
    if (primitives[id].kind != core::PrimitiveKind::triangle) {
      continue;
    }
    const std::array<Vec3f, 3> corner = vertices(primitives[id]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (corner[k] == vertex) {
        if (passes(across, corner[(k + 1) % 3], corner[(k + 2) % 3], near)) {
          return {};  // the fan's border
        }
        const Across::Point center = across(vertex);
        sectors.push_back(sector_of(from(center, across(corner[(k + 1) % 3])), from(center, across(corner[(k + 2) % 3]))));
        fan.push_back(id);
      }
    }
  }
  // A sector that begins before the first one's start may extend around the circle, so the sectors are laid out twice.
  const std::size_t count = sectors.size();
  for (std::size_t k = 0; k < count; ++k) {
    sectors.push_back({sectors[k].first + 2 * std::numbers::pi, sectors[k].extent});
  }
  return cover_circle(std::move(sectors)) ? fan : std::vector<std::uint32_t>{};
}

std::vector<std::uint32_t> around_edge(std::span<const PrimitiveValues> primitives, const Vec3f& a, const Vec3f& b,
                                       const Across& across, double near) {
  std::vector<std::uint32_t> fan;
  bool left = false, right = false;
  for (std::uint32_t id = 0; id < primitives.size(); ++id) {
    if (primitives[id].kind != core::PrimitiveKind::triangle) {
      continue;
    }
    const std::array<Vec3f, 3> corner = vertices(primitives[id]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f &first = corner[k], &second = corner[(k + 1) % 3], &third = corner[(k + 2) % 3];
      if ((first == a && second == b) || (first == b && second == a)) {
        if (passes(across, second, third, near) || passes(across, third, first, near)) {
          return {};  // the fan's border
        }
        const double side = turn(from(across(a), across(b)), from(across(a), across(third)));
        left = left || side > 0;
        right = right || side < 0;
        fan.push_back(id);
      }
    }
  }
  return left && right ? fan : std::vector<std::uint32_t>{};
}

}  // namespace

std::vector<std::uint32_t> closed_fan(const Ray& ray, std::span<const PrimitiveValues> primitives, std::uint32_t id) {
  const Across across(ray);
  const std::array<Vec3f, 3> corner = vertices(primitives[id]);
  const double near = rounding_of(ray, corner);
  const Feature feature = feature_near(corner, across, near);
  std::vector<std::uint32_t> fan;
  if (feature.vertex) {
    fan = around_vertex(primitives, corner[*feature.vertex], across, near);
  } else if (feature.edge) {
    fan = around_edge(primitives, corner[*feature.edge], corner[(*feature.edge + 1) % 3], across, near);
  }
  const bool holds_ignored = std::find(fan.begin(), fan.end(), ray.ignored_primitive) != fan.end();
  return holds_ignored ? std::vector<std::uint32_t>{} : fan;
}

}  // namespace dmpc::apps
