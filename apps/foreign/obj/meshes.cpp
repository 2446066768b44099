#include "apps/foreign/obj/meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "apps/foreign/obj/part.h"
#include "apps/foreign/obj/smoothing.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;
using List = std::span<const std::uint32_t>;

/// What faces of one mesh have in common.
struct Kind {
  std::uint32_t material = 0;
  bool has_places = false;  ///< on the material's texture
  bool operator<(const Kind& other) const {
    return std::pair(material, has_places) < std::pair(other.material, other.has_places);
  }
};

/// The faces of each kind, one kind after the other.
struct Sorted {
  std::vector<Kind> kinds;
  std::vector<std::uint32_t> faces, ends;  ///< the list, and of each kind one past its last
};

/// Calls take(face, its kind's number), and gives the kinds.
template <class Take>
std::vector<Kind> for_each_face(const Geometry& geometry, const std::vector<std::uint32_t>& run_materials,
                                const std::vector<MaterialUse>& uses, const Take& take) {
  std::vector<Kind> kinds;
  std::map<Kind, std::uint32_t> numbers;
  for (std::size_t run = 0; run < geometry.runs.size(); ++run) {
    const bool is_last = run + 1 == geometry.runs.size();
    const auto end = is_last ? static_cast<std::uint32_t>(geometry.faces.ends.size()) : geometry.runs[run + 1].first_face;
    for (std::uint32_t face = geometry.runs[run].first_face; face < end; ++face) {
      const std::uint32_t material = run_materials[run];
      const Kind kind{material, uses[material].texture && geometry.faces.has_places(face)};
      const auto [known, is_new] = numbers.try_emplace(kind, static_cast<std::uint32_t>(kinds.size()));
      if (is_new) {
        kinds.push_back(kind);
      }
      take(face, known->second);
    }
  }
  return kinds;
}

Sorted sorted_faces(const Geometry& geometry, const std::vector<std::uint32_t>& run_materials,
                    const std::vector<MaterialUse>& uses) {
  Sorted sorted;
  std::vector<std::uint32_t> next;  // first of each kind how many, then where its next face belongs
  sorted.kinds = for_each_face(geometry, run_materials, uses, [&next](std::uint32_t, std::uint32_t kind) {
    next.resize(std::max<std::size_t>(next.size(), kind + 1));
    ++next[kind];
  });
  std::partial_sum(next.begin(), next.end(), std::back_inserter(sorted.ends));
  std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
  sorted.faces.resize(geometry.faces.ends.size());
  for_each_face(geometry, run_materials, uses,
                [&](std::uint32_t face, std::uint32_t kind) { sorted.faces[next[kind]++] = face; });
  return sorted;
}

template <class Take>
void for_each_corner(const Faces& faces, List list, const Take& take) {
  for (const std::uint32_t face : list) {
    for (std::size_t i = faces.begin_of(face); i < faces.ends[face]; ++i) {
      take(i);
    }
  }
}

/// `smooth` as group_normals() gives it.
void add_normals(const Geometry& geometry, const std::vector<Vec3d>& smooth, List list, PolygonMesh& mesh) {
  const Faces& faces = geometry.faces;
  const auto has_some = [&](std::uint32_t face) {
    return faces.has_normals(face) || (!smooth.empty() && faces.groups[face] != 0);
  };
  if (!std::any_of(list.begin(), list.end(), has_some)) {
    return;
  }
  mesh.normals.reserve(mesh.faces.corners.size());
  for_each_corner(faces, list, [&](std::size_t i) {
    const bool has_own = !faces.normals.empty() && faces.normals[i] != none;
    mesh.normals.push_back(has_own ? geometry.normals[faces.normals[i]] : smooth.empty() ? Vec3d{} : smooth[i]);
  });
}

/// A file's t grows upwards.
void add_places(const Geometry& geometry, const TexturePlace& place, List list, PolygonMesh& mesh) {
  mesh.places.reserve(mesh.faces.corners.size());
  for_each_corner(geometry.faces, list, [&](std::size_t i) {
    const auto& [u, v] = geometry.places[geometry.faces.places[i]];
    const auto [s, t] = place(u, 1 - v);
    mesh.places.push_back({static_cast<float>(s), static_cast<float>(t)});
  });
}

void add_vertices(Geometry& geometry, bool is_all, List list, PartFinder& finder, PolygonMesh& mesh) {
  if (is_all) {
    mesh.vertices = std::exchange(geometry.vertices, {});
    mesh.faces = {.corners = geometry.faces.vertices, .ends = geometry.faces.ends};
    return;
  }
  Part part = finder.part(geometry.faces, list);
  mesh.faces = std::move(part.faces);
  mesh.vertices.reserve(part.vertices.size());
  for (const std::uint32_t vertex : part.vertices) {
    mesh.vertices.push_back(geometry.vertices[vertex]);
  }
}

void add_colors(const Geometry& geometry, List list, PolygonMesh& mesh) {
  if (!geometry.colors.empty()) {
    mesh.colors.reserve(mesh.faces.corners.size());
    for_each_corner(geometry.faces, list,
                    [&](std::size_t i) { mesh.colors.push_back(geometry.colors[geometry.faces.vertices[i]]); });
  }
}

}  // namespace

std::vector<PolygonMesh> meshes_of(Geometry geometry, const std::vector<std::uint32_t>& run_materials,
                                   const std::vector<MaterialUse>& uses) {
  const std::vector<Vec3d> smooth = group_normals(geometry.vertices, geometry.faces);
  const Sorted sorted = sorted_faces(geometry, run_materials, uses);
  PartFinder finder(sorted.kinds.size() > 1 ? geometry.vertices.size() : 0);
  std::vector<PolygonMesh> meshes;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < sorted.kinds.size(); ++i) {
    const List list(sorted.faces.data() + begin, sorted.ends[i] - begin);
    const MaterialUse& use = uses[sorted.kinds[i].material];
    PolygonMesh mesh{.name = use.name, .material = sorted.kinds[i].material};
    add_vertices(geometry, sorted.kinds.size() == 1, list, finder, mesh);
    add_normals(geometry, smooth, list, mesh);
    if (sorted.kinds[i].has_places) {
      add_places(geometry, *use.texture, list, mesh);
    }
    add_colors(geometry, list, mesh);
    meshes.push_back(std::move(mesh));
    begin = sorted.ends[i];
  }
  return meshes;
}

}  // namespace dmpc::apps::obj
