#include "apps/foreign/mesh/scene_totals.h"

#include "apps/foreign/mesh/placed_file.h"
#include "apps/formats/reading_memory.h"
#include "apps/frontend/line/number_text.h"
#include "core/scene/base_meshes.h"

namespace dmpc::apps {

GeometrySize size_of_faces(std::uint64_t faces, std::uint64_t corners, std::uint64_t corner_bytes) {
  return {.triangles = corners - 2 * faces,
          .faces = faces,
          .corners = corners,
          .bytes = sizeof(core::Object) * faces + (sizeof(core::Vec3d) + corner_bytes) * corners};
}

GeometrySize size_of_copy(const PolygonMesh& mesh) {
  return size_of_faces(mesh.faces.ends.size(), mesh.faces.corners.size(),
                       !mesh.colors.empty()    ? sizeof(core::TexturedCorner)
                       : !mesh.normals.empty() ? sizeof(core::Vec3d)
                                               : 0);
}

GeometrySize size_of(const PolygonMesh& mesh) {
  const auto bytes_of = [](const auto&... lists) { return ((lists.size() * sizeof(lists[0])) + ...); };
  GeometrySize size = size_of_copy(mesh);
  size.bytes += bytes_of(mesh.vertices, mesh.faces.corners, mesh.faces.ends, mesh.normals, mesh.places, mesh.colors, mesh.alphas);
  return size;
}

GeometrySize size_of_places(std::uint64_t count) {
  return {.places = count, .bytes = count * (sizeof(ShapePlace) + sizeof(core::Instance))};
}

GeometrySize SceneTotals::size_of_place(const GeometrySize& copy) const {
  GeometrySize size = size_of_places(1);
  const bool is_kept = copies_ == core::Copies::left_out && copy.triangles > core::copied_triangles_max;
  return is_kept ? size : size += copy;
}

void SceneTotals::check(const GeometrySize& size) const {
  check_database(size.triangles);
  if (size.bytes > memory_bytes_max_) {
    const std::string places = size.places == 0 ? "" : ", with " + grouped(size.places) + " further places of meshes";
    const bool may_keep = size.places > 0 && copies_ == core::Copies::put;
    throw core::CapacityError("its " + grouped(size.triangles) + " triangles so far take at least " + bytes_text(size.bytes) +
                              " of memory" + places + ", and a file's scene may take " + bytes_text(memory_bytes_max_) +
                              ": make the scene smaller, or divide it" +
                              (may_keep ? ", or have dmpc render keep each mesh once (--instances=keep)" : ""));
  }
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max() - std::uint64_t{1};
  if (size.corners > most) {
    throw core::CapacityError("with every instance the scene has " + grouped(size.triangles) + " triangles with " +
                              grouped(size.corners) + " corners; there can be " + grouped(most) + " corners at most: divide it");
  }
}

}  // namespace dmpc::apps
