#include "apps/foreign/polygon/indexed_mesh.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/mesh/geometry.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

Vec3d color_vec(const Color& color) { return {double{color[0]}, double{color[1]}, double{color[2]}}; }

/// For each face the material that is its own times its colour's; no_index, and no new material, if there are too many.
std::optional<std::vector<std::uint32_t>> coloured_materials(const IndexedMesh& mesh, PlacedFile& file) {
  std::map<std::pair<std::uint32_t, Color>, std::uint32_t> known;
  std::vector<std::uint32_t> materials;
  const auto first = static_cast<std::uint32_t>(file.materials.size());
  materials.reserve(mesh.face_colors.size());
  for (std::size_t i = 0; i < mesh.face_colors.size(); ++i) {
    const std::uint32_t own = mesh.face_materials.empty() ? 0 : mesh.face_materials[i];
    const auto next = first + static_cast<std::uint32_t>(known.size());
    materials.push_back(known.try_emplace({own, mesh.face_colors[i]}, next).first->second);
    if (known.size() > face_colors_max) {
      return std::nullopt;
    }
  }
  file.materials.resize(first + known.size());
  for (const auto& [kind, number] : known) {
    file.materials[number] = file.materials[kind.first];
    core::Material& material = file.materials[number].material;
    material.color = material.color * color_vec(kind.second);
  }
  return materials;
}

/// Takes faces out of a mesh, with what their corners have.
class Part {
 public:
  explicit Part(const IndexedMesh& mesh) : mesh_(mesh) {}

  /// What corners of the face have, but for their vertices.
  void add_corners(std::size_t face, PolygonMesh& part) const;
  /// The corners, among the part's own vertices.
  void add_face(std::size_t face, PolygonMesh& part);
  /// The next part has vertices of its own.
  void end(std::span<const std::uint32_t> faces);

  std::size_t begin_of(std::size_t face) const { return face == 0 ? 0 : mesh_.faces.ends[face - 1]; }

 private:
  const IndexedMesh& mesh_;
  std::vector<std::uint32_t> places_;  ///< of the mesh's vertices among the part's
};

void Part::add_corners(std::size_t face, PolygonMesh& part) const {
  for (std::size_t corner = begin_of(face); corner < mesh_.faces.ends[face]; ++corner) {
    const std::uint32_t vertex = mesh_.faces.corners[corner];
    if (!mesh_.normals.empty()) {
      part.normals.push_back(mesh_.normals[vertex]);
    }
    if (!mesh_.corner_places.empty() || !mesh_.places.empty()) {
      part.places.push_back(mesh_.corner_places.empty() ? mesh_.places[vertex] : mesh_.corner_places[corner]);
    }
    if (!mesh_.face_colors.empty() || !mesh_.colors.empty()) {
      part.colors.push_back(color_vec(mesh_.face_colors.empty() ? mesh_.colors[vertex] : mesh_.face_colors[face]));
    }
  }
}

void Part::add_face(std::size_t face, PolygonMesh& part) {
  places_.resize(mesh_.vertices.size(), no_index);
  for (std::size_t corner = begin_of(face); corner < mesh_.faces.ends[face]; ++corner) {
    const std::uint32_t vertex = mesh_.faces.corners[corner];
    if (places_[vertex] == no_index) {
      places_[vertex] = static_cast<std::uint32_t>(part.vertices.size());
      part.vertices.push_back(mesh_.vertices[vertex]);
    }
    part.faces.corners.push_back(places_[vertex]);
  }
  part.faces.ends.push_back(static_cast<std::uint32_t>(part.faces.corners.size()));
  add_corners(face, part);
}

void Part::end(std::span<const std::uint32_t> faces) {
  for (const std::uint32_t face : faces) {
    for (std::size_t corner = begin_of(face); corner < mesh_.faces.ends[face]; ++corner) {
      places_[mesh_.faces.corners[corner]] = no_index;
    }
  }
}

/// What each corner has, and not each vertex.
void give_corners(const IndexedMesh& mesh, PolygonMesh& whole) {
  const std::size_t count = mesh.faces.corners.size();
  whole.normals.reserve(mesh.normals.empty() ? 0 : count);
  whole.places.reserve(mesh.places.empty() && mesh.corner_places.empty() ? 0 : count);
  whole.colors.reserve(mesh.colors.empty() && mesh.face_colors.empty() ? 0 : count);
  const Part part(mesh);
  for (std::size_t face = 0; face < mesh.faces.ends.size(); ++face) {
    part.add_corners(face, whole);
  }
}

/// All of it, without a second copy of what it has.
PolygonMesh whole_of(IndexedMesh mesh, std::size_t material) {
  PolygonMesh whole{.name = mesh.name, .material = material};
  whole.is_by_vertex = mesh.corner_places.empty() && mesh.face_colors.empty();
  if (whole.is_by_vertex) {
    whole.normals = std::move(mesh.normals);
    whole.places = std::move(mesh.places);
    whole.colors.reserve(mesh.colors.size());
    std::transform(mesh.colors.begin(), mesh.colors.end(), std::back_inserter(whole.colors), color_vec);
  } else {
    give_corners(mesh, whole);
  }
  whole.vertices = std::move(mesh.vertices);
  whole.faces = std::move(mesh.faces);
  return whole;
}

/// The faces' numbers by their materials, in the file's order among those of one.
std::vector<std::uint32_t> sorted_faces(const std::vector<std::uint32_t>& materials) {
  std::vector<std::uint32_t> faces(materials.size());
  std::iota(faces.begin(), faces.end(), 0U);
  std::stable_sort(faces.begin(), faces.end(), [&](auto a, auto b) { return materials[a] < materials[b]; });
  return faces;
}

void add_parts(const IndexedMesh& mesh, PlacedFile& file) {
  const std::vector<std::uint32_t> faces = sorted_faces(mesh.face_materials);
  Part source(mesh);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    const std::uint32_t material = mesh.face_materials[faces[begin]];
    PolygonMesh part{.name = mesh.name, .material = material};
    for (end = begin; end < faces.size() && mesh.face_materials[faces[end]] == material; ++end) {
      source.add_face(faces[end], part);
    }
    source.end(std::span(faces).subspan(begin, end - begin));
    file.add(std::move(part));
  }
}

}  // namespace

void IndexedMesh::add_face(std::span<const std::uint32_t> corners) {
  if (corners.size() >= no_index - faces.corners.size()) {
    throw core::RoomError(name + " has more corners than there can be, " + grouped(std::uint64_t{no_index}) + ": divide it");
  }
  faces.corners.insert(faces.corners.end(), corners.begin(), corners.end());
  faces.ends.push_back(static_cast<std::uint32_t>(faces.corners.size()));
}

void add_meshes(IndexedMesh mesh, PlacedFile& file) {
  if (mesh.faces.ends.empty()) {
    return;
  }
  if (!mesh.face_colors.empty()) {
    if (auto materials = coloured_materials(mesh, file)) {
      mesh.face_materials = *std::move(materials);
      mesh.face_colors = {};
    }
  }
  const auto& materials = mesh.face_materials;
  const auto is_other = [&](std::uint32_t material) { return material != materials.front(); };
  if (materials.empty() || std::none_of(materials.begin(), materials.end(), is_other)) {
    const std::size_t material = materials.empty() ? 0 : materials.front();
    file.add(whole_of(std::move(mesh), material));
  } else {
    add_parts(mesh, file);
  }
}

}  // namespace dmpc::apps
