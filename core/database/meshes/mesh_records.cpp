#include "core/database/meshes/mesh_records.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/database/conversion.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/tree/bvh_builder.h"
#include "core/scene/base_meshes.h"

namespace dmpc::core {
namespace {

/// Boxes of BVH nodes contain their primitives with this padding; the instance decides how far rays keep from them.
constexpr double box_pad = 0x1p-30;

/// A grid whose single cell contains the mesh.
GridFrame frame_around() {
  GridFrame frame;
  frame.low = {-2, -2, -2};
  frame.resolution = {cells_per_macro, cells_per_macro, cells_per_macro};
  frame.finest_cell = 4.0F / finest_per_macro;
  return frame;
}

class MeshConverter {
 public:
  MeshConverter(const Scene& mesh, std::span<const Material> materials, MeshRecords& records)
      : mesh_(mesh), materials_(materials), records_(records) {}

  void add(const MeshTriangle& triangle) {
    const Object& object = mesh_.objects[triangle.object];
    if (object.kind == ObjectKind::patch && has_normals(object)) {
      add_normals(object, triangle.corner);
    } else if (object.kind == ObjectKind::textured) {
      add_texture(object, triangle.corner);
    }
    PrimitiveValues values{.kind = PrimitiveKind::triangle};
    for (std::size_t row = 0; row < value_count(values.kind); ++row) {
      const Vec3d& vertex = mesh_.vertices[object.first + triangle.corner[row / 3]];
      values.value[row] = static_cast<float>(vertex[row % 3] / records_.unit);
    }
    values.lie_in(triangle.plane);
    records_.conversion.primitives.push_back(values);
    records_.conversion.shading.push_back(ShadingReference::flat(object.material));
  }

 private:
  std::uint32_t id() const { return static_cast<std::uint32_t>(records_.conversion.primitives.size()); }

  /// A copy without normals is flat.
  bool has_normals(const Object& object) const {
    const auto normals = std::span(mesh_.normals).subspan(object.first_normal, object.vertex_count);
    return std::any_of(normals.begin(), normals.end(), [](const Vec3d& normal) { return !(normal == Vec3d{}); });
  }

  void add_normals(const Object& object, const std::array<std::uint32_t, 3>& corners) {
    PatchNormals normals{.normal = {}, .material_bits = object.material};
    for (std::size_t i = 0; i < 3; ++i) {
      normals.normal[i] = Vec3f(mesh_.normals[object.first_normal + corners[i]]);
    }
    records_.conversion.smooth.push_back({id(), normals});
  }

  void add_texture(const Object& object, const std::array<std::uint32_t, 3>& corners) {
    const Material& material = materials_[object.material];
    TexturedNormals textured;
    textured.normals.material_bits = object.material | PatchNormals::textured_flag;
    for (std::size_t i = 0; i < 3; ++i) {
      const TexturedCorner& corner = mesh_.corners[object.first_normal + corners[i]];
      textured.normals.normal[i] = Vec3f(corner.normal);
      textured.place[i] = material.texture == Material::no_texture ? corner.place : usable_place(corner.place);
    }
    records_.conversion.textured.push_back({id(), material.texture, material.microfacets.texture, textured});
  }

  const Scene& mesh_;
  std::span<const Material> materials_;
  MeshRecords& records_;
};

}  // namespace

MeshRecords records_of(const Scene& mesh, std::span<const Material> materials, const MeshFaces& faces, const Parallel& parallel) {
  MeshRecords records{.conversion = {}, .unit = unit_of(mesh), .tree = {}};
  for (const MeshPlane& plane : faces.planes) {
    records.conversion.planes.push_back({plane, plane.is_level ? LeafHeader::level_plane : plane.stored_as});
  }
  MeshConverter converter(mesh, materials, records);
  for (const MeshTriangle& triangle : faces.triangles) {
    converter.add(triangle);
  }
  std::vector<std::uint32_t> ids(faces.triangles.size());
  std::iota(ids.begin(), ids.end(), 0U);
  records.tree = BvhBuilder(records.conversion.primitives, box_pad, frame_around(), parallel).build({0, 0, 0}, ids);
  return records;
}

MeshesRecords records_of(const Scene& scene, std::span<const MeshFaces> faces, const std::vector<bool>& places,
                         const Parallel& parallel) {
  std::vector<bool> is_kept(faces.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i]) {
      is_kept[scene.kept->places[i].mesh] = true;
    }
  }
  MeshesRecords meshes;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    meshes.index.push_back(is_kept[i] ? static_cast<std::uint32_t>(meshes.records.size()) : MeshesRecords::nowhere);
    if (is_kept[i]) {
      meshes.records.push_back(records_of(scene.kept->meshes[i], scene.materials, faces[i], parallel));
    }
  }
  return meshes;
}

}  // namespace dmpc::core
