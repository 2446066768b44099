#include "core/scene/triangulate.h"

#include <algorithm>

#include "core/base/ranges.h"
#include "core/scene/ear_clipper.h"
#include "core/scene/flat_polygon.h"

namespace dmpc::core {
namespace {

/// Twice the area, as a vector along the normal (Newell's method).
Vec3d area_vector(std::span<const Vec3d> vertices) {
  Vec3d sum;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    sum = sum + cross(vertices[i] - vertices[0], vertices[i + 1 < vertices.size() ? i + 1 : 0] - vertices[0]);
  }
  return sum;
}

bool is_fan(const FlatPolygon& seen, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (seen.turn(i, (i + 1) % count, (i + 2) % count) < 0) {
      return false;
    }
  }
  // Every corner turns left, but a star may wind twice: then the fan has a triangle that turns right. A fan also fails where a
  // corner lies on a straight edge: a triangle without area would be dropped and leave a crack.
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    if (!(seen.turn(0, i, i + 1) > 0)) {
      return false;
    }
  }
  return true;
}

/// Below this size squares of areas, products of four such sizes, may underflow.
constexpr double size_min = 0x1p-240;
/// Scales such sizes so that they do not underflow, and none of them overflows.
constexpr double enlargement = 0x1p480;

double size_of(std::span<const Vec3d> vertices) {
  return max_over(vertices, double{0}, [&](const Vec3d& vertex) { return largest_component(vertex - vertices[0]); });
}

bool is_tiny(std::span<const Vec3d> vertices) {
  const double size = size_of(vertices);
  return size > 0 && size < size_min;
}

std::vector<Vec3d> enlarged_copy(std::span<const Vec3d> vertices) {
  return mapped<Vec3d>(vertices, [&](const Vec3d& vertex) { return (vertex - vertices[0]) * enlargement; });
}

}  // namespace

/// One product decides for a triangle, unless it is so small that the product underflows.
bool has_area(std::span<const Vec3d> vertices) {
  if (vertices.size() == 3) {
    const Vec3d normal = cross(vertices[1] - vertices[0], vertices[2] - vertices[0]);
    if (dot(normal, normal) > 0) {
      return true;
    }
  }
  if (is_tiny(vertices)) {
    return has_area(enlarged_copy(vertices));
  }
  const Vec3d normal = area_vector(vertices);
  return dot(normal, normal) > 0;
}

std::vector<CornerTriangle> triangulate(std::span<const Vec3d> vertices) {
  if (is_tiny(vertices)) {
    return triangulate(enlarged_copy(vertices));
  }
  const auto count = static_cast<std::uint32_t>(vertices.size());
  const Vec3d normal = area_vector(vertices);
  std::vector<CornerTriangle> triangles;
  if (!(dot(normal, normal) > 0)) {
    return triangles;
  }
  if (count == 3) {
    return {{0, 1, 2}};
  }
  const FlatPolygon seen(vertices, normal);
  if (is_fan(seen, count)) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
      triangles.push_back({0, i, i + 1});
    }
    return triangles;
  }
  return clip_ears(seen).triangles;
}

}  // namespace dmpc::core
