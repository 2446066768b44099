#include "apps/foreign/obj/smoothing.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "apps/foreign/mesh/smooth.h"
#include "apps/foreign/obj/part.h"

namespace dmpc::apps::obj {
namespace {

/// Those whose normals are to be reckoned, group by group.
std::vector<std::uint32_t> smooth_faces(const Faces& faces) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t face = 0; face < faces.groups.size(); ++face) {
    if (faces.groups[face] != 0 && !faces.has_normals(face)) {
      list.push_back(face);
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [&faces](std::uint32_t a, std::uint32_t b) { return faces.groups[a] < faces.groups[b]; });
  return list;
}

}  // namespace

std::vector<core::Vec3d> group_normals(const std::vector<core::Vec3d>& vertices, const Faces& faces) {
  constexpr double any_angle = 180;
  const std::vector<std::uint32_t> list = smooth_faces(faces);
  std::vector<core::Vec3d> normals(list.empty() ? 0 : faces.vertices.size());
  PartFinder finder(vertices.size());
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    while (end < list.size() && faces.groups[list[end]] == faces.groups[list[begin]]) {
      ++end;
    }
    const std::span<const std::uint32_t> group(list.data() + begin, end - begin);
    const Part part = finder.part(faces, group);
    std::vector<core::Vec3d> corners;
    for (const std::uint32_t vertex : part.vertices) {
      corners.push_back(vertices[vertex]);
    }
    const std::vector<core::Vec3d> smooth = smooth_normals(corners, part.faces, any_angle);
    std::size_t next = 0;
    for (const std::uint32_t face : group) {
      for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
        normals[i] = smooth[next++];
      }
    }
  }
  return normals;
}

}  // namespace dmpc::apps::obj
