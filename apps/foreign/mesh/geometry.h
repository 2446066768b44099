// The faces of placed meshes as the objects of a scene.
#pragma once

#include <assimp/mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placement.h"
#include "apps/foreign/mesh/smooth.h"
#include "apps/foreign/mesh/texture_place.h"
#include "core/base/counts.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What faces of three or more corners become.
struct GeometrySize {
  std::uint64_t triangles = 0, faces = 0, corners = 0;

  GeometrySize& operator+=(const GeometrySize& other) { return core::add_counts(*this, other); }
};
GeometrySize size_of(const aiMesh& mesh);
/// Throws core::RoomError if the indices of a scene do not reach so far.
void check_size(const GeometrySize& size);

/// "mesh 3 'wheel'", for messages.
std::string name_of(const aiMesh& mesh, std::size_t index);

/// A material by the file's index.
struct MeshMaterial {
  core::Material material;
  unsigned coordinates = 0;  ///< which of a mesh's texture coordinates its texture goes by
  TexturePlace place{};      ///< where on its texture they lie
};

/// Adds meshes to a scene, which has been given the textures of `materials` before. Faces become polygons, or patches where they
/// have vertex normals that differ, textured ones if their material and their mesh say how; points and lines are left out. A
/// mirroring transform keeps the side to which a face looks.
class GeometryWriter {
 public:
  /// `smooth_degrees`: vertex normals are reckoned anew (apps/foreign/mesh/smooth.h), whatever the file has.
  GeometryWriter(core::SceneBuilder& builder, const std::vector<MeshMaterial>& materials, std::optional<double> smooth_degrees)
      : builder_(builder), materials_(materials), smooth_degrees_(smooth_degrees) {}

  /// Throws core::InputError with the mesh's name for a coordinate that is not finite or beyond 1e30, an index of a vertex or
  /// material that does not exist, or a polygon with too many corners.
  void add(const aiMesh& mesh, std::size_t index, const Transform& world);

  /// Whether any face had an area.
  bool has_area() const { return has_area_; }

 private:
  void read_vertices(const aiMesh& mesh, std::size_t index, const Transform& world);
  void read_faces(const aiMesh& mesh, std::size_t index, bool is_mirrored);
  void read_normals(const aiMesh& mesh, const Transform& world);
  void read_places(const aiMesh& mesh, unsigned coordinates, const TexturePlace& place);
  core::Material material_for(const aiMesh& mesh, std::size_t index);
  /// The face of these corners.
  void add_face(std::size_t first, std::size_t end);
  void add_textured(std::size_t first, std::size_t end);

  core::SceneBuilder& builder_;
  const std::vector<MeshMaterial>& materials_;
  std::optional<double> smooth_degrees_;
  bool has_area_ = false;
  FaceList faces_;
  std::vector<core::Vec3d> vertices_;         ///< the mesh's, in the world
  std::vector<core::Vec3d> normals_;          ///< of corners; none if the mesh is flat
  std::vector<std::array<float, 2>> places_;  ///< of vertices on the texture; none without one
  std::vector<core::Vec3d> face_vertices_, face_normals_;
  std::vector<core::TexturedCorner> face_corners_;
};

}  // namespace dmpc::apps
