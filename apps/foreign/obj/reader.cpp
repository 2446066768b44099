#include "apps/foreign/obj/reader.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/smooth.h"
#include "apps/foreign/obj/libraries.h"
#include "apps/foreign/obj/materials.h"
#include "apps/foreign/obj/parser.h"

namespace dmpc::apps {
namespace obj {
namespace {

using core::Vec3d;

std::vector<FaceRun> runs_of(const Geometry& geometry, const Materials& materials) {
  std::vector<FaceRun> runs;
  geometry.for_each_face([&](std::uint32_t face, std::size_t run) {
    const std::size_t material = materials.of_runs[run];
    const bool has_places = materials.list[material].texture && geometry.faces.has_places(face);
    if (runs.empty() || runs.back().material != material || runs.back().has_places != has_places) {
      runs.push_back({.material = material, .has_places = has_places});
    }
    runs.back().end = face + 1;
  });
  return runs;
}

/// Returns normals for corners that have none of their own; empty if no face is smooth.
std::vector<Vec3d> group_normals(const Geometry& geometry) {
  constexpr double any_angle = 180;
  std::vector<std::uint32_t> groups = geometry.faces.groups;
  for (std::size_t face = 0; face < groups.size(); ++face) {
    groups[face] = geometry.faces.has_normals(face) ? 0 : groups[face];
  }
  const bool has_some = std::any_of(groups.begin(), groups.end(), [](std::uint32_t group) { return group != 0; });
  return has_some ? smooth_normals(geometry.vertices, geometry.faces, any_angle, groups) : std::vector<Vec3d>{};
}

std::vector<Vec3d> normals_of(const Geometry& geometry) {
  std::vector<Vec3d> normals = group_normals(geometry);
  const std::vector<std::uint32_t>& own = geometry.faces.normals;
  normals.resize(own.empty() ? normals.size() : geometry.faces.corners.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    normals[i] = own[i] == none ? normals[i] : geometry.normals[own[i]];
  }
  return normals;
}

/// In the file t increases upwards.
std::vector<std::array<float, 2>> places_of(const Geometry& geometry, const Materials& materials) {
  std::vector<std::array<float, 2>> places(geometry.faces.places.empty() ? 0 : geometry.faces.corners.size());
  geometry.for_each_face([&](std::uint32_t face, std::size_t run) {
    for (std::size_t i = geometry.faces.begin_of(face); geometry.faces.has_places(face) && i < geometry.faces.ends[face]; ++i) {
      const auto& [u, v] = geometry.places[geometry.faces.places[i]];
      const auto [s, t] = materials.places[materials.of_runs[run]](u, 1 - v);
      places[i] = {static_cast<float>(s), static_cast<float>(t)};
    }
  });
  return places;
}

/// Requires at least one face. Faces keep the file's order, because the first of several coplanar faces is visible. Texture
/// coordinates are mapped to the textures of their materials. Faces of one smoothing group without normals of their own are
/// smooth among themselves, whatever the angle (apps/foreign/mesh/smooth.h).
PolygonMesh mesh_of(Geometry geometry, const Materials& materials) {
  PolygonMesh mesh{.name = "the mesh", .is_by_vertex = true};
  mesh.runs = runs_of(geometry, materials);
  mesh.material = mesh.runs.front().material;
  std::vector<Vec3d> normals = normals_of(geometry);
  std::vector<std::array<float, 2>> places = places_of(geometry, materials);
  mesh.vertices = std::move(geometry.vertices);
  mesh.colors = std::move(geometry.colors);
  mesh.faces = std::move(geometry.faces);
  mesh.spread_to_corners();
  mesh.normals = std::move(normals);
  mesh.places = std::move(places);
  return mesh;
}

Geometry read_geometry(const std::string& path, SceneFiles& files) {
  const std::unique_ptr<FileBytes> file = files.open(path);
  return parse_obj(
      text_of(*file), [&files](float share) { files.show_progress(share); }, files.totals());
}

void append(std::vector<std::string> more, std::vector<std::string>& all) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace
}  // namespace obj

PlacedFile read_obj(const std::string& path, SceneFiles& files) {
  PlacedFile result;
  obj::Geometry geometry = obj::read_geometry(path, files);
  obj::Libraries libraries(geometry.material_names, path, files);
  for (const std::string& names : geometry.libraries) {
    libraries.read(names);
  }
  obj::Materials materials = obj::materials_of(geometry, libraries);
  result.notes = std::move(geometry.notes);
  obj::append(std::move(libraries.notes), result.notes);
  libraries.note_repeated(result.notes);
  obj::append(std::move(materials.notes), result.notes);
  result.missing = std::move(libraries.missing);
  if (!geometry.runs.empty()) {
    result.add(obj::mesh_of(std::move(geometry), materials));
  }
  result.materials = std::move(materials.list);
  return result;
}

}  // namespace dmpc::apps
