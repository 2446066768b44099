#include "core/database/meshes/mesh_faces.h"

#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "core/database/conversion.h"
#include "core/database/faces/coplanar.h"
#include "core/database/grid/macro_cells.h"
#include "core/scene/base_meshes.h"
#include "core/scene/detail.h"
#include "core/scene/frame.h"

namespace dmpc::core {
namespace {

/// Records and planes of one mesh in its own grid, before they are moved to the mesh's own coordinates.
class MeshJudge {
 public:
  MeshJudge(const Scene& mesh, std::span<const Material> materials, double cells_per_primitive, const Parallel& parallel)
      : mesh_(mesh) {
    mesh_.materials.assign(materials.begin(), materials.end());
    const Box bounds = bounds_of(mesh_, parallel);
    frame_ = fit_frame(bounds, mesh_.objects.size(), cells_per_primitive);
    if (const auto place = place_of_detail(mesh_, bounds)) {
      move_zero(frame_, *place);
    }
    conversion_ = convert(mesh_, frame_, parallel, {.keeps_corners = true});
    GridFrame cells_frame = frame_;
    std::optional<MacroCells> cells;
    while (!(cells = MacroCells::list(conversion_.primitives, cells_frame, insertion_pad(cells_frame, 0), parallel))) {
      coarsen(cells_frame);
    }
    settle_coplanar(conversion_, *cells, mesh_, frame_, parallel);
  }

  MeshFaces faces() {
    MeshFaces result{
        .dropped = conversion_.dropped, .duplicates = conversion_.duplicates, .shared_planes = conversion_.shared_planes};
    for (const PrimitivePlane& plane : conversion_.planes) {
      const double offset = plane.offset * (1 / frame_.scale) + dot(plane.normal, frame_.origin);
      result.planes.push_back({{plane.normal, offset}, plane.stored_as});
    }
    for (std::uint32_t id = 0; id < conversion_.primitives.size(); ++id) {
      const std::uint32_t plane = conversion_.primitives[id].plane();
      result.triangles.push_back({conversion_.sources[id].object, conversion_.corners[id],
                                  plane == PrimitiveValues::level_plane ? level_plane(id, result.planes) : plane});
    }
    for (const CollapsedPrimitive& one : conversion_.collapsed) {
      result.collapsed.push_back({own(one.place), own(one.size)});
    }
    for (const CloseFaces& one : conversion_.close_faces) {
      result.close_faces.push_back({own(one.place), own(one.size), own(one.least), own(one.most), one.layers});
    }
    return result;
  }

 private:
  Vec3d own(const Vec3d& local) const { return local * (1 / frame_.scale) + frame_.origin; }
  Vec3f own(const Vec3f& local) const { return Vec3f(own(Vec3d(local))); }
  float own(float size) const { return static_cast<float>(double{size} / frame_.scale); }

  /// The number of a plane that a coordinate identifies. Rounding to floats may merge two heights of doubles, so only faces whose
  /// doubles all lie at one height are level wherever they are moved to.
  std::uint32_t level_plane(std::uint32_t id, std::vector<MeshPlane>& planes) {
    const auto& value = conversion_.primitives[id].value;
    std::size_t axis = 0;
    while (value[axis] != value[axis + 3] || value[axis] != value[axis + 6]) {
      ++axis;
    }
    const Object& object = mesh_.objects[conversion_.sources[id].object];
    const auto corner = [&](std::size_t i) { return mesh_.vertices[object.first + conversion_.corners[id][i]]; };
    const auto [place, is_new] = levels_.try_emplace({axis, value[axis]}, planes.size() + 1);
    if (is_new) {
      MeshPlane& level = planes.emplace_back();
      level.normal[axis] = 1;
      level.offset = corner(0)[axis];
      level.is_level = true;
    }
    MeshPlane& plane = planes[place->second - 1];
    for (std::size_t i = 0; i < 3; ++i) {
      plane.is_level = plane.is_level && corner(i)[axis] == plane.offset;
    }
    return static_cast<std::uint32_t>(place->second);
  }

  Scene mesh_;
  GridFrame frame_;
  Conversion conversion_;
  std::map<std::pair<std::size_t, float>, std::size_t> levels_;  ///< numbers of level planes
};

}  // namespace

MeshFaces faces_of_mesh(const Scene& mesh, std::span<const Material> materials, double cells_per_primitive,
                        const Parallel& parallel) {
  return MeshJudge(mesh, materials, cells_per_primitive, parallel).faces();
}

std::vector<MeshFaces> faces_of_meshes(const Scene& scene, double cells_per_primitive, const Parallel& parallel) {
  std::vector<MeshFaces> faces;
  if (scene.kept != nullptr) {
    for (const Scene& mesh : scene.kept->meshes) {
      faces.push_back(faces_of_mesh(mesh, scene.materials, cells_per_primitive, parallel));
    }
  }
  return faces;
}

}  // namespace dmpc::core
