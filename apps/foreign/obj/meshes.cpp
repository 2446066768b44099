#include "apps/foreign/obj/meshes.h"

#include <numeric>
#include <utility>

#include "apps/foreign/obj/part.h"
#include "apps/foreign/obj/smoothing.h"

namespace dmpc::apps::obj {
namespace {

using core::Vec3d;

/// Faces of one mesh, which follow one another in the file.
struct Stretch {
  std::uint32_t first = 0, end = 0;
  std::uint32_t material = 0;
  bool has_places = false;  ///< on the material's texture
};

std::vector<Stretch> stretches_of(const Geometry& geometry, const std::vector<std::uint32_t>& run_materials,
                                  const std::vector<MaterialUse>& uses) {
  std::vector<Stretch> all;
  for (std::size_t run = 0; run < geometry.runs.size(); ++run) {
    const bool is_last = run + 1 == geometry.runs.size();
    const auto end = is_last ? static_cast<std::uint32_t>(geometry.faces.ends.size()) : geometry.runs[run + 1].first_face;
    for (std::uint32_t face = geometry.runs[run].first_face; face < end; ++face) {
      const std::uint32_t material = run_materials[run];
      const bool has_places = uses[material].texture && geometry.faces.has_places(face);
      if (all.empty() || all.back().material != material || all.back().has_places != has_places) {
        all.push_back({face, face, material, has_places});
      }
      all.back().end = face + 1;
    }
  }
  return all;
}

template <class Take>
void for_each_corner(const Faces& faces, const Stretch& stretch, const Take& take) {
  for (std::size_t i = faces.begin_of(stretch.first); i < faces.ends[stretch.end - 1]; ++i) {
    take(i);
  }
}

/// `smooth` as group_normals() gives it.
void add_normals(const Geometry& geometry, const std::vector<Vec3d>& smooth, const Stretch& stretch, PolygonMesh& mesh) {
  const Faces& faces = geometry.faces;
  bool has_some = false;
  for (std::uint32_t face = stretch.first; face < stretch.end && !has_some; ++face) {
    has_some = faces.has_normals(face) || (!smooth.empty() && faces.groups[face] != 0);
  }
  if (!has_some) {
    return;
  }
  mesh.normals.reserve(mesh.faces.corners.size());
  for_each_corner(faces, stretch, [&](std::size_t i) {
    const bool has_own = !faces.normals.empty() && faces.normals[i] != none;
    mesh.normals.push_back(has_own ? geometry.normals[faces.normals[i]] : smooth.empty() ? Vec3d{} : smooth[i]);
  });
}

/// A file's t grows upwards.
void add_places(const Geometry& geometry, const TexturePlace& place, const Stretch& stretch, PolygonMesh& mesh) {
  mesh.places.reserve(mesh.faces.corners.size());
  for_each_corner(geometry.faces, stretch, [&](std::size_t i) {
    const auto& [u, v] = geometry.places[geometry.faces.places[i]];
    const auto [s, t] = place(u, 1 - v);
    mesh.places.push_back({static_cast<float>(s), static_cast<float>(t)});
  });
}

void add_vertices(Geometry& geometry, bool is_all, const Stretch& stretch, PartFinder& finder, PolygonMesh& mesh) {
  if (is_all) {
    mesh.vertices = std::exchange(geometry.vertices, {});
    mesh.faces = {.corners = geometry.faces.vertices, .ends = geometry.faces.ends};
    return;
  }
  std::vector<std::uint32_t> list(stretch.end - stretch.first);
  std::iota(list.begin(), list.end(), stretch.first);
  Part part = finder.part(geometry.faces, list);
  mesh.faces = std::move(part.faces);
  mesh.vertices.reserve(part.vertices.size());
  for (const std::uint32_t vertex : part.vertices) {
    mesh.vertices.push_back(geometry.vertices[vertex]);
  }
}

void add_colors(const Geometry& geometry, const Stretch& stretch, PolygonMesh& mesh) {
  if (!geometry.colors.empty()) {
    mesh.colors.reserve(mesh.faces.corners.size());
    for_each_corner(geometry.faces, stretch,
                    [&](std::size_t i) { mesh.colors.push_back(geometry.colors[geometry.faces.vertices[i]]); });
  }
}

}  // namespace

std::vector<PolygonMesh> meshes_of(Geometry geometry, const std::vector<std::uint32_t>& run_materials,
                                   const std::vector<MaterialUse>& uses) {
  const std::vector<Vec3d> smooth = group_normals(geometry.vertices, geometry.faces);
  const std::vector<Stretch> stretches = stretches_of(geometry, run_materials, uses);
  const bool is_all = stretches.size() == 1;
  PartFinder finder(is_all ? 0 : geometry.vertices.size());
  std::vector<PolygonMesh> meshes;
  meshes.reserve(stretches.size());
  for (const Stretch& stretch : stretches) {
    const MaterialUse& use = uses[stretch.material];
    PolygonMesh mesh{.name = use.name, .material = stretch.material};
    add_vertices(geometry, is_all, stretch, finder, mesh);
    add_normals(geometry, smooth, stretch, mesh);
    if (stretch.has_places) {
      add_places(geometry, *use.texture, stretch, mesh);
    }
    add_colors(geometry, stretch, mesh);
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace dmpc::apps::obj
