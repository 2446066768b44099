#include "apps/foreign/mesh/placed_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// So that all look to the other side.
void turn_round(FaceList& faces) {
  std::uint32_t first = 0;
  for (const std::uint32_t end : faces.ends) {
    std::reverse(faces.corners.begin() + first, faces.corners.begin() + end);
    first = end;
  }
}

void read_faces(const aiMesh& mesh, bool is_mirrored, PolygonMesh& result) {
  FaceList& faces = result.faces;
  const GeometrySize size = size_of(mesh);
  faces.ends.reserve(faces.ends.size() + size.faces);
  faces.corners.reserve(faces.corners.size() + size.corners);
  for (std::size_t i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) {
      continue;
    }
    if (std::any_of(face.mIndices, face.mIndices + face.mNumIndices,
                    [&mesh](unsigned vertex) { return vertex >= mesh.mNumVertices; })) {
      throw core::InputError(result.name + ": face " + std::to_string(i) + " has a vertex that does not exist: the mesh has " +
                             std::to_string(mesh.mNumVertices) + "; correct the file");
    }
    faces.corners.insert(faces.corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
    faces.ends.push_back(static_cast<std::uint32_t>(faces.corners.size()));
  }
  if (is_mirrored) {
    turn_round(faces);
  }
}

void read_normals(const aiMesh& mesh, const Transform& world, PolygonMesh& result) {
  const Transform of_normals = world.of_normals();
  result.normals.reserve(result.faces.corners.size());
  for (const std::uint32_t vertex : result.faces.corners) {
    result.normals.push_back(of_normals.direction(to_vec(mesh.mNormals[vertex])));
  }
}

/// A file's t grows upwards.
void read_places(const aiMesh& mesh, const MeshMaterial& material, PolygonMesh& result) {
  const bool is_plain = material.place.is_plain();
  result.places.reserve(result.faces.corners.size());
  for (const std::uint32_t vertex : result.faces.corners) {
    const aiVector3D& source = mesh.mTextureCoords[material.coordinates][vertex];
    const std::array<float, 2> plain = {source.x, 1 - source.y};
    const auto [s, t] = material.place(double{plain[0]}, double{plain[1]});
    result.places.push_back(is_plain ? plain : std::array<float, 2>{static_cast<float>(s), static_cast<float>(t)});
  }
}

/// None if all are white.
void read_colors(const aiMesh& mesh, PolygonMesh& result) {
  bool is_white = true, is_opaque = true;
  for (const std::uint32_t vertex : result.faces.corners) {
    const aiColor4D& color = mesh.mColors[0][vertex];
    result.colors.push_back({double{color.r}, double{color.g}, double{color.b}});
    result.alphas.push_back(double{color.a});
    is_white = is_white && result.colors.back() == core::Vec3d{1, 1, 1};
    is_opaque = is_opaque && color.a >= 1;
  }
  if (is_opaque) {
    result.alphas.clear();
  }
  if (is_opaque && is_white) {
    result.colors.clear();
  }
}

}  // namespace

std::string name_of(const aiMesh& mesh, std::size_t index) {
  const std::string number = "mesh " + std::to_string(index);
  return mesh.mName.length > 0 ? number + " '" + mesh.mName.C_Str() + "'" : number;
}

GeometrySize size_of(const aiMesh& mesh) {
  GeometrySize size;
  for (std::size_t i = 0; i < mesh.mNumFaces; ++i) {
    size += size_of_face(mesh.mFaces[i].mNumIndices);
  }
  return size;
}

PolygonMesh placed_mesh(const aiMesh& mesh, std::size_t index, FaceList triangles, const Transform& world,
                        const MeshMaterial& material) {
  PolygonMesh result{.name = name_of(mesh, index), .material = mesh.mMaterialIndex, .faces = std::move(triangles)};
  read_faces(mesh, world.determinant() < 0, result);
  if (result.faces.ends.empty()) {
    return result;  // points and lines alone
  }
  result.vertices.reserve(mesh.mNumVertices);
  for (std::size_t i = 0; i < mesh.mNumVertices; ++i) {
    result.vertices.push_back(world.point(to_vec(mesh.mVertices[i])));
  }
  if (mesh.HasNormals() && world.determinant() != 0) {  // what is pressed flat has the normals of its plane
    read_normals(mesh, world, result);
  }
  if (mesh.HasVertexColors(0)) {
    read_colors(mesh, result);
  }
  if (material.material.texture != core::Material::no_texture && mesh.HasTextureCoords(material.coordinates)) {
    read_places(mesh, material, result);
  }
  return result;
}

}  // namespace dmpc::apps
