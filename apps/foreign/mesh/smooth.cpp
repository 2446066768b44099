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

/// Who meets whom: corners at one point, of faces of one group, have one number.
struct Meetings {
  std::vector<std::uint32_t> of_corners;
  std::uint32_t count = 0;
};

Meetings meetings_of(const std::vector<Vec3d>& vertices, const FaceList& faces, std::span<const std::uint32_t> groups) {
  const std::vector<std::uint32_t> points = points_of(vertices);
  const auto group_of = [groups](std::uint32_t face) { return groups.empty() ? 0 : groups[face]; };
  std::vector<std::uint32_t> order(faces.ends.size()), known(points.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!groups.empty()) {
    std::stable_sort(order.begin(), order.end(), [groups](auto a, auto b) { return groups[a] < groups[b]; });
  }
  Meetings meetings{.of_corners = std::vector<std::uint32_t>(faces.corners.size()), .count = 1};
  std::uint32_t first_of_group = 1;
  for (std::size_t n = 0; n < order.size(); ++n) {
    first_of_group = n > 0 && group_of(order[n]) != group_of(order[n - 1]) ? meetings.count : first_of_group;
    for (std::size_t i = faces.begin_of(order[n]); i < faces.ends[order[n]]; ++i) {
      std::uint32_t& meeting = known[points[faces.corners[i]]];
      meeting = meeting < first_of_group ? meetings.count++ : meeting;
      meetings.of_corners[i] = meeting;
    }
  }
  return meetings;
}

/// The faces that meet, in order: those of meeting m are list[ends[m - 1]] to list[ends[m]].
struct Neighbours {
  std::vector<std::uint32_t> ends, list;
};

Neighbours neighbours_of(const FaceList& faces, const Meetings& meetings) {
  Neighbours neighbours{std::vector<std::uint32_t>(meetings.count + 1), std::vector<std::uint32_t>(faces.corners.size())};
  for (const std::uint32_t meeting : meetings.of_corners) {
    ++neighbours.ends[meeting + 1];
  }
  std::partial_sum(neighbours.ends.begin(), neighbours.ends.end(), neighbours.ends.begin());
  for (std::uint32_t face = 0; face < faces.ends.size(); ++face) {  // ends[m], until now the beginning of m, moves to its end
    for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
      neighbours.list[neighbours.ends[meetings.of_corners[i]]++] = face;
    }
  }
  return neighbours;
}

/// Twice the area times the normal.
Vec3d area_vector(const std::vector<Vec3d>& vertices, const FaceList& faces, std::size_t face) {
  const std::size_t first = faces.begin_of(face);
  const Vec3d origin = vertices[faces.corners[first]];
  Vec3d sum;
  for (std::size_t i = first + 1; i + 1 < faces.ends[face]; ++i) {
    sum = sum + cross(vertices[faces.corners[i]] - origin, vertices[faces.corners[i + 1]] - origin);
  }
  return sum;
}

bool within(const Vec3d& a, const Vec3d& b, double cosine) { return dot(a, b) >= cosine * length(a) * length(b); }

/// Where every face counts: each meeting's sum once, so that many faces around one point cost no more than their number.
std::vector<Vec3d> sums_of_all(const FaceList& faces, const Meetings& meetings, const std::vector<Vec3d>& areas) {
  std::vector<Vec3d> sums(meetings.count), normals(faces.corners.size());
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
      sums[meetings.of_corners[i]] = sums[meetings.of_corners[i]] + areas[face];
    }
  }
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
      normals[i] = areas[face] == Vec3d{} ? Vec3d{} : sums[meetings.of_corners[i]];
    }
  }
  return normals;
}

}  // namespace

std::vector<Vec3d> smooth_normals(const std::vector<Vec3d>& vertices, const FaceList& faces, double degrees,
                                  std::span<const std::uint32_t> groups) {
  const Meetings meetings = meetings_of(vertices, faces, groups);
  std::vector<Vec3d> areas(faces.ends.size());
  for (std::size_t face = 0; face < areas.size(); ++face) {
    areas[face] = groups.empty() || groups[face] != 0 ? area_vector(vertices, faces, face) : Vec3d{};
  }
  if (degrees >= 180) {
    return sums_of_all(faces, meetings, areas);
  }
  std::vector<Vec3d> normals(faces.corners.size());
  const Neighbours neighbours = neighbours_of(faces, meetings);
  const double cosine = core::cos_degrees(degrees);
  for (std::size_t face = 0; face < areas.size(); ++face) {
    for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
      const std::uint32_t meeting = meetings.of_corners[i];
      for (std::uint32_t n = neighbours.ends[meeting - 1]; n < neighbours.ends[meeting]; ++n) {
        const Vec3d& other = areas[neighbours.list[n]];
        normals[i] = within(areas[face], other, cosine) && !(areas[face] == Vec3d{}) ? normals[i] + other : normals[i];
      }
    }
  }
  return normals;
}

}  // namespace dmpc::apps
