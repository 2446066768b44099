#include "apps/foreign/mesh/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/edge/line/number_text.h"
#include "apps/formats/nff_reader.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double coordinate_max = 1e30;

bool is_usable(const Vec3d& v) {
  return std::abs(v.x) < coordinate_max && std::abs(v.y) < coordinate_max && std::abs(v.z) < coordinate_max;
}

bool all_equal(const std::vector<Vec3d>& list) {
  return std::all_of(list.begin(), list.end(), [&list](const Vec3d& v) { return v == list.front(); });
}

bool spans_an_area(const std::vector<Vec3d>& corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (!(cross(corners[i - 1] - corners[0], corners[i] - corners[0]) == Vec3d{})) {
      return true;
    }
  }
  return false;
}

}  // namespace

GeometrySize size_of(const aiMesh& mesh) {
  GeometrySize size;
  for (std::size_t i = 0; i < mesh.mNumFaces; ++i) {
    const std::uint64_t corners = mesh.mFaces[i].mNumIndices;
    size += corners < 3 ? GeometrySize{} : GeometrySize{corners - 2, 1, corners};
  }
  return size;
}

void check_size(const GeometrySize& size) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};
  if (size.corners > most) {
    throw core::RoomError("with every instance the scene has " + grouped(size.triangles) + " triangles with " +
                          grouped(size.corners) + " corners; there can be " + grouped(most) + " corners at most: divide it");
  }
}

std::string name_of(const aiMesh& mesh, std::size_t index) {
  const std::string number = "mesh " + std::to_string(index);
  return mesh.mName.length > 0 ? number + " '" + mesh.mName.C_Str() + "'" : number;
}

void GeometryWriter::add(const aiMesh& mesh, std::size_t index, const Transform& world) {
  read_faces(mesh, index, world.determinant() < 0);
  if (faces_.ends.empty()) {
    return;  // points and lines alone
  }
  read_vertices(mesh, index, world);
  read_normals(mesh, world);
  builder_.material(material_for(mesh, index));
  std::size_t first = 0;
  for (const std::uint32_t end : faces_.ends) {
    add_face(first, end);
    first = end;
  }
}

/// That of the mesh, without its texture if the mesh does not say where it goes; reads places if it does.
core::Material GeometryWriter::material_for(const aiMesh& mesh, std::size_t index) {
  if (mesh.mMaterialIndex >= materials_.size()) {
    throw core::InputError(name_of(mesh, index) + " has material " + std::to_string(mesh.mMaterialIndex) +
                           ", and there are but " + std::to_string(materials_.size()));
  }
  auto [material, coordinates, place] = materials_[mesh.mMaterialIndex];
  places_.clear();
  if (material.texture != core::Material::no_texture && mesh.HasTextureCoords(coordinates)) {
    read_places(mesh, coordinates, place);
  } else {
    material.texture = core::Material::no_texture;
  }
  return material;
}

/// A file's t grows upwards.
void GeometryWriter::read_places(const aiMesh& mesh, unsigned coordinates, const TexturePlace& place) {
  const bool is_plain = place.is_plain();
  for (std::size_t i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& source = mesh.mTextureCoords[coordinates][i];
    const std::array<float, 2> plain = {source.x, 1 - source.y};
    const auto [s, t] = place(double{plain[0]}, double{plain[1]});
    places_.push_back(is_plain ? plain : std::array<float, 2>{static_cast<float>(s), static_cast<float>(t)});
  }
}

void GeometryWriter::read_vertices(const aiMesh& mesh, std::size_t index, const Transform& world) {
  vertices_.resize(mesh.mNumVertices);
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    vertices_[i] = world.point(to_vec(mesh.mVertices[i]));
    if (!is_usable(vertices_[i])) {
      throw core::InputError(name_of(mesh, index) + ": vertex " + std::to_string(i) +
                             " has a coordinate that is not a number, infinite or beyond 1e30; correct the file");
    }
  }
}

void GeometryWriter::read_faces(const aiMesh& mesh, std::size_t index, bool is_mirrored) {
  faces_.corners.clear();
  faces_.ends.clear();
  for (std::size_t i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) {
      continue;
    }
    const bool is_known = std::all_of(face.mIndices, face.mIndices + face.mNumIndices,
                                      [&mesh](unsigned vertex) { return vertex < mesh.mNumVertices; });
    if (!is_known || face.mNumIndices > polygon_vertices_max) {
      throw core::InputError(name_of(mesh, index) + ": face " + std::to_string(i) +
                             (is_known ? " has too many corners, more than 65535"
                                       : " has a vertex that does not exist: the mesh has " + std::to_string(mesh.mNumVertices)) +
                             "; correct the file");
    }
    faces_.corners.insert(faces_.corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
    if (is_mirrored) {
      std::reverse(faces_.corners.end() - face.mNumIndices, faces_.corners.end());
    }
    faces_.ends.push_back(static_cast<std::uint32_t>(faces_.corners.size()));
  }
}

void GeometryWriter::read_normals(const aiMesh& mesh, const Transform& world) {
  normals_.clear();
  if (smooth_degrees_) {
    normals_ = smooth_normals(vertices_, faces_, *smooth_degrees_);
  } else if (mesh.HasNormals()) {
    const Transform of_normals = world.of_normals();
    normals_.reserve(faces_.corners.size());
    for (const std::uint32_t vertex : faces_.corners) {
      normals_.push_back(of_normals.direction(to_vec(mesh.mNormals[vertex])));
    }
  }
}

void GeometryWriter::add_face(std::size_t first, std::size_t end) {
  face_vertices_.clear();
  for (std::size_t i = first; i < end; ++i) {
    face_vertices_.push_back(vertices_[faces_.corners[i]]);
  }
  has_area_ = has_area_ || spans_an_area(face_vertices_);
  if (!normals_.empty()) {
    face_normals_.assign(normals_.begin() + static_cast<std::ptrdiff_t>(first),
                         normals_.begin() + static_cast<std::ptrdiff_t>(end));
  }
  const bool is_flat = normals_.empty() || all_equal(face_normals_);
  if (!places_.empty()) {
    face_normals_.resize(is_flat ? 0 : end - first);
    add_textured(first, end);
  } else if (is_flat) {
    builder_.polygon(face_vertices_);
  } else {
    builder_.patch(face_vertices_, face_normals_);
  }
}

void GeometryWriter::add_textured(std::size_t first, std::size_t end) {
  face_corners_.clear();
  for (std::size_t i = first; i < end; ++i) {
    const core::Vec3d normal = face_normals_.empty() ? core::Vec3d{} : face_normals_[i - first];
    face_corners_.push_back({normal, places_[faces_.corners[i]]});
  }
  builder_.textured(face_vertices_, face_corners_);
}

}  // namespace dmpc::apps
