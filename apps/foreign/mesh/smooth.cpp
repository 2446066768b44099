#include "apps/foreign/mesh/smooth.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

#include "core/base/elementary.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr auto coordinates(const Vec3d& v) { return std::tuple(v.x, v.y, v.z); }

/// For each vertex the first one of those at its point.
std::vector<std::uint32_t> points_of(const std::vector<Vec3d>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), points(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&vertices](std::uint32_t a, std::uint32_t b) {
    return std::tuple(coordinates(vertices[a]), a) < std::tuple(coordinates(vertices[b]), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
    points[order[i]] = is_same ? points[order[i - 1]] : order[i];
  }
  return points;
}

/// The faces around each point, in order: those of point p are list[ends[p - 1]] to list[ends[p]].
struct Neighbours {
  std::vector<std::uint32_t> ends, list;
};

std::uint32_t begin_of(const std::vector<std::uint32_t>& ends, std::size_t i) { return i == 0 ? 0 : ends[i - 1]; }

Neighbours neighbours_of(const FaceList& faces, const std::vector<std::uint32_t>& points) {
  Neighbours neighbours{std::vector<std::uint32_t>(points.size() + 1), std::vector<std::uint32_t>(faces.corners.size())};
  for (const std::uint32_t corner : faces.corners) {
    ++neighbours.ends[points[corner] + 1];
  }
  std::partial_sum(neighbours.ends.begin(), neighbours.ends.end(), neighbours.ends.begin());
  for (std::uint32_t face = 0; face < faces.ends.size(); ++face) {  // ends[p], until now the beginning of p, moves to its end
    for (std::size_t i = begin_of(faces.ends, face); i < faces.ends[face]; ++i) {
      neighbours.list[neighbours.ends[points[faces.corners[i]]]++] = face;
    }
  }
  return neighbours;
}

/// Twice the area times the normal.
Vec3d area_vector(const std::vector<Vec3d>& vertices, const FaceList& faces, std::size_t face) {
  const std::size_t first = begin_of(faces.ends, face);
  const Vec3d origin = vertices[faces.corners[first]];
  Vec3d sum;
  for (std::size_t i = first + 1; i + 1 < faces.ends[face]; ++i) {
    sum = sum + cross(vertices[faces.corners[i]] - origin, vertices[faces.corners[i + 1]] - origin);
  }
  return sum;
}

bool within(const Vec3d& a, const Vec3d& b, double cosine) { return dot(a, b) >= cosine * length(a) * length(b); }

/// Where every face counts: each point's sum once, so that many faces around one cost no more than their number.
std::vector<Vec3d> sums_of_all(const FaceList& faces, const std::vector<std::uint32_t>& points, const std::vector<Vec3d>& areas) {
  std::vector<Vec3d> sums(points.size()), normals(faces.corners.size());
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = begin_of(faces.ends, face); i < faces.ends[face]; ++i) {
      sums[points[faces.corners[i]]] = sums[points[faces.corners[i]]] + areas[face];
    }
  }
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = begin_of(faces.ends, face); i < faces.ends[face]; ++i) {
      normals[i] = areas[face] == Vec3d{} ? Vec3d{} : sums[points[faces.corners[i]]];
    }
  }
  return normals;
}

}  // namespace

std::vector<Vec3d> smooth_normals(const std::vector<Vec3d>& vertices, const FaceList& faces, double degrees) {
  const std::vector<std::uint32_t> points = points_of(vertices);
  std::vector<Vec3d> areas(faces.ends.size());
  for (std::size_t face = 0; face < areas.size(); ++face) {
    areas[face] = area_vector(vertices, faces, face);
  }
  if (degrees >= 180) {
    return sums_of_all(faces, points, areas);
  }
  std::vector<Vec3d> normals(faces.corners.size());
  const Neighbours neighbours = neighbours_of(faces, points);
  const double cosine = core::cos_degrees(degrees);
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = begin_of(faces.ends, face); i < faces.ends[face]; ++i) {
      const std::uint32_t point = points[faces.corners[i]];
      for (std::uint32_t n = begin_of(neighbours.ends, point); n < neighbours.ends[point]; ++n) {
        const Vec3d& other = areas[neighbours.list[n]];
        normals[i] = within(areas[face], other, cosine) && !(areas[face] == Vec3d{}) ? normals[i] + other : normals[i];
      }
    }
  }
  return normals;
}

}  // namespace dmpc::apps
