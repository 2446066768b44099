#include "core/database/mesh_records.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/database/brick_builder.h"
#include "core/database/usable_place.h"
#include "core/scene/kept_meshes.h"

namespace dmpc::core {
namespace {

/// Of a mesh's largest coordinate, so that records, in units of it, keep all the bits that floats have.
constexpr int exponent_max = 100;
/// Boxes of bricks hold what is in them; how far rays keep from them is the place's to say.
constexpr double box_pad = 0x1p-30;

bool is_in_float(double value) { return double{static_cast<float>(value)} == value; }
bool is_in_floats(const Vec3d& v) { return is_in_float(v.x) && is_in_float(v.y) && is_in_float(v.z); }

bool shines(const Scene& mesh, std::span<const Material> materials) {
  return std::any_of(mesh.objects.begin(), mesh.objects.end(),
                     [&](const Object& object) { return materials[object.material].shines(); });
}

/// The power of two above all of the mesh's coordinates; 0 if floats in units of it do not hold them.
double unit_of(const Scene& mesh) {
  double largest = 0;
  for (const Vec3d& vertex : mesh.vertices) {
    largest = std::max(largest, largest_component(vertex));
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  if (!(largest > 0) || std::abs(exponent) > exponent_max) {
    return 0;
  }
  const double unit = std::ldexp(1.0, exponent);
  const bool are_held = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&](const Vec3d& vertex) {
    return is_in_floats(vertex) && is_in_floats(vertex * (1 / unit));
  });
  return are_held ? unit : 0;
}

bool has_normals_in_floats(const Scene& mesh) {
  return std::all_of(mesh.normals.begin(), mesh.normals.end(), is_in_floats) &&
         std::all_of(mesh.corners.begin(), mesh.corners.end(),
                     [](const TexturedCorner& corner) { return is_in_floats(corner.normal); });
}

/// A cell that has all of it.
GridFrame frame_around() {
  GridFrame frame;
  frame.low = {-2, -2, -2};
  frame.resolution = {cells_per_top, cells_per_top, cells_per_top};
  frame.finest_cell = 4.0F / finest_per_top;
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

  /// A copy without any is flat.
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

std::optional<MeshRecords> records_of(const Scene& mesh, std::span<const Material> materials, const MeshFaces& faces,
                                      const Parallel& parallel) {
  MeshRecords records{.conversion = {}, .unit = unit_of(mesh), .tree = {}};
  if (records.unit == 0 || faces.triangles.empty() || faces.triangles.size() > kept_triangles_max || shines(mesh, materials) ||
      !has_normals_in_floats(mesh)) {
    return std::nullopt;
  }
  for (const MeshPlane& plane : faces.planes) {
    records.conversion.planes.push_back({plane, plane.is_level ? BlockHeader::level_plane : plane.kept_as});
  }
  MeshConverter converter(mesh, materials, records);
  for (const MeshTriangle& triangle : faces.triangles) {
    converter.add(triangle);
  }
  std::vector<std::uint32_t> ids(faces.triangles.size());
  std::iota(ids.begin(), ids.end(), 0U);
  records.tree = BrickBuilder(records.conversion.primitives, box_pad, frame_around(), parallel).build({0, 0, 0}, ids);
  return records;
}

}  // namespace dmpc::core
