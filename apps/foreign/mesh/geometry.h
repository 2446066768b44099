// Converts the faces of meshes to objects of a scene.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "apps/formats/indexed_vertices.h"
#include "core/base/box.h"
#include "core/scene/instances.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Up to this number of face colours become materials; further colours are stored at corners.
inline constexpr std::size_t face_colors_max = 256;

/// Adds meshes to a scene. Faces become polygons, or patches where vertex normals differ from the face's own; textured ones if
/// the material has a texture and the mesh has texture coordinates, coloured ones if it has no texture and the mesh has colours.
/// Faces of one colour share a material of that colour, as long as there are few. A mesh with several instances is added once by
/// add_shared() and then instanced by place(); whoever takes the scene has to expand the instances.
class GeometryWriter {
 public:
  /// The scene has no vertices of its own, these go to `vertices`, and nobody else adds to it. `smooth_degrees`: vertex normals
  /// are recomputed (apps/foreign/mesh/smooth.h), even if the mesh has some.
  GeometryWriter(core::Scene& scene, IndexedVertices& vertices, std::optional<double> smooth_degrees)
      : scene_(scene), builder_(scene), vertices_(vertices), smooth_degrees_(smooth_degrees) {}

  /// `materials`: all materials that faces can refer to; a mesh without texture coordinates loses the texture. Throws
  /// core::InputError with the mesh's name for a corner's coordinate that is not finite or beyond 1e30, an invalid vertex index,
  /// or a polygon with too many corners.
  void add(PolygonMesh mesh, std::span<const FileMaterial> materials);

  /// Adds a base mesh in its own coordinates, without an instance. Returns its number for place(); nothing if it has no faces.
  /// Throws as add() does. Not with smooth_degrees: the sharpness of an edge depends on the transform.
  std::optional<std::uint32_t> add_shared(PolygonMesh mesh, std::span<const FileMaterial> materials);
  /// Adds an instance of a base mesh, behind everything before in the file's order. Throws core::InputError with the mesh's name
  /// if its coordinates exceed 1e30.
  void place(std::uint32_t mesh, const core::Transform& world);
  /// The instances of all shared meshes.
  const core::Instances& instances() const { return instances_; }

  /// Adds a sphere, without a texture.
  void add(const core::Sphere& sphere, core::Material material);

  /// Skips an invisible mesh, which only counts for has_area().
  void leave_out() { has_area_ = true; }

  /// Whether any face had an area.
  bool has_area() const { return has_area_; }
  /// Number of meshes whose material has a texture, but which have no texture coordinates.
  std::uint64_t unplaced() const { return unplaced_; }
  /// Number of meshes whose material is fully transparent.
  std::uint64_t unseen() const { return unseen_; }
  /// Number of unused vertices with coordinates that are not finite or beyond 1e30, and the first of them.
  std::uint64_t strays() const { return strays_; }
  const std::string& first_stray() const { return first_stray_; }
  /// Number of meshes with textured faces whose vertex colours are not shown.
  std::uint64_t meshes_without_colors() const { return meshes_without_colors_; }

 private:
  /// Properties of a base mesh beside its objects.
  struct Shared {
    std::string name;
    core::Box box;
    std::uint64_t unplaced = 0, unseen = 0, without_colors = 0;  ///< counts that each of its instances adds
  };

  void add_objects(PolygonMesh mesh, std::span<const FileMaterial> materials);
  /// Adds the mesh's faces from this one on.
  void add_run(const PolygonMesh& mesh, const FaceRun& run, std::size_t first_face, core::Material material);
  void settle_vertices(PolygonMesh& mesh);
  bool has_area_in(const core::SharedMesh& mesh, const core::Transform& world) const;
  /// The face of these corners.
  void add_face(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end);
  void add_corners(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end);
  void add_flat_or_smooth(std::size_t corners);
  void keep_vertices(std::vector<core::Vec3d> points, std::vector<std::uint32_t> indices);
  bool set_one_color(const PolygonMesh& mesh, const core::Material& material, std::size_t first, std::size_t end);

  core::Scene& scene_;
  core::SceneBuilder builder_;
  IndexedVertices& vertices_;
  std::optional<double> smooth_degrees_;
  core::Instances instances_;
  std::vector<Shared> shared_;  ///< by index in Instances::meshes
  bool is_shared_ = false;      ///< a base mesh is being added
  bool has_area_ = false;
  bool has_places_ = false, hides_colors_ = false;  ///< the current run's
  std::uint64_t unplaced_ = 0, unseen_ = 0, meshes_without_colors_ = 0, strays_ = 0;
  std::string first_stray_;
  std::set<std::array<double, 3>> face_colors_;  ///< colours of single-coloured faces
  std::vector<core::Vec3d> face_vertices_, face_normals_;
  std::vector<core::Vec3d> smooth_;  ///< recomputed normals, one per corner of the mesh
  std::vector<core::TexturedCorner> face_corners_;
};

}  // namespace dmpc::apps
