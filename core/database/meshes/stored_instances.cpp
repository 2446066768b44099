#include "core/database/meshes/stored_instances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "core/base/expect.h"
#include "core/database/meshes/obstacle.h"
#include "core/database/tree/overlap.h"
#include "core/record/coordinate.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// If the pad is larger than the mesh by this factor, the instance is copied: its boxes would not distinguish rays.
constexpr double pad_max = 0x1p20;

/// The length along one of the mesh's axes of a pad that is this long along each of the grid's axes, in units of records.
double pad_in_mesh(const Transform& world, const GridFrame& frame, double unit, double pad) {
  constexpr double rounded_up = 1 + 0x1p-20;  // far more than the rounding of the inverse of what can_be_instanced()
  const std::array<Vec3d, 3> columns = inverse_of(rows_in_grid(world, unit, frame));
  double most = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    most = std::max(most, std::fabs(columns[0][axis]) + std::fabs(columns[1][axis]) + std::fabs(columns[2][axis]));
  }
  return pad * most * rounded_up;
}

/// Moves primitives to other positions.
class Keeper {
 public:
  Keeper(const Scene& scene, std::span<const MeshFaces> faces, const GridFrame& frame, double pad, Conversion& conversion)
      : scene_(scene), faces_(faces), frame_(frame), pad_(pad), conversion_(conversion) {}

  StoredInstances keep(const Parallel& parallel) {
    choose(parallel);
    std::vector<bool> is_own(conversion_.primitives.size());
    for (std::size_t i = 0; i < is_own.size();) {
      const BaseMeshInstance* const place = place_of(scene_, conversion_.sources[i].object);
      if (place != nullptr && is_kept_[static_cast<std::size_t>(place - scene_.kept->places.data())]) {
        i = add_place(*place, i);
      } else {
        is_own[i] = true;
        result_.own_ids.push_back(static_cast<std::uint32_t>(from_.size()));
        copy(i++);
      }
    }
    if (!result_.empty()) {
      result_.meshes = std::move(meshes_.records);
      result_.reported.resize(from_.size());
      std::iota(result_.reported.begin(), result_.reported.end(), 0U);
      const auto is_copys = [&](const auto& item) { return !is_own[item.primitive]; };
      std::erase_if(conversion_.smooth, is_copys);
      std::erase_if(conversion_.textured, is_copys);
      rearrange(conversion_, from_);
    }
    return std::move(result_);
  }

 private:
  void choose(const Parallel& parallel) {
    std::vector<Obstacle> obstacles = obstacles_of(scene_, faces_, parallel);
    for (const Obstacle obstacle : obstacles) {
      is_kept_.push_back(obstacle == Obstacle::none);
    }
    meshes_ = records_of(scene_, faces_, is_kept_, parallel);
    for (std::size_t i = 0; i < is_kept_.size(); ++i) {
      const BaseMeshInstance& place = scene_.kept->places[i];
      if (is_kept_[i] && !can_have_boxes(place.world, frame_, meshes_.records[meshes_.index[place.mesh]].unit, pad_)) {
        is_kept_[i] = false;
        obstacles[i] = Obstacle::smallness;
      }
    }
    add(obstacles, result_.copied);
  }

  void copy(std::size_t i) { from_.push_back(static_cast<std::uint32_t>(i)); }

  /// Adds the instance whose copy begins at `i`; returns where the copy ends.
  std::size_t add_place(const BaseMeshInstance& place, std::size_t i) {
    const MeshFaces& faces = faces_[place.mesh];
    const Scene& mesh = scene_.kept->meshes[place.mesh];
    const Placing placing(place.world, frame_);
    StoredInstance instance{place.world, meshes_.index[place.mesh], static_cast<std::uint32_t>(from_.size()), {}};
    for (const MeshTriangle& triangle : faces.triangles) {
      const Object& object = mesh.objects[triangle.object];
      std::array<Vec3d, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = Vec3d(coordinates_of(placing.corner(mesh.vertices[object.first + triangle.corner[k]])));
      }
      if (leaves_nothing(corners)) {
        copy(conversion_.primitives.size());
        conversion_.primitives.push_back({.kind = PrimitiveKind::triangle});
        conversion_.sources.push_back({place.at + triangle.object});
        conversion_.shading.push_back(ShadingReference::flat(object.material));
      } else {
        const std::size_t first = placing.is_mirrored() ? 2 : 0;
        expect(i < conversion_.primitives.size() && conversion_.sources[i].object == place.at + triangle.object &&
                   conversion_.primitives[i].vector(0) == corners[first],
               "a copy has the triangles of its mesh, in their order");
        instance.bounds.include(rounded_bounds_of(conversion_.primitives[i]));
        copy(i++);
      }
    }
    result_.places.push_back(instance);
    return i;
  }

  const Scene& scene_;
  std::span<const MeshFaces> faces_;
  const GridFrame& frame_;
  double pad_;
  Conversion& conversion_;
  StoredInstances result_;
  MeshesRecords meshes_;
  std::vector<bool> is_kept_;        ///< by instance
  std::vector<std::uint32_t> from_;  ///< for each new position, the old one
};

}  // namespace

bool can_have_boxes(const Transform& world, const GridFrame& frame, double unit, double pad) {
  return pad_in_mesh(world, frame, unit, pad) <= pad_max;
}

InstanceRecord StoredInstances::record_of(const StoredInstance& place, const GridFrame& frame, double pad) const {
  InstanceRecord record;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      record.world[3 * row + axis] = place.world.rows[row][axis];
    }
    record.world[9 + row] = place.world.shift[row];
  }
  const double unit = meshes[place.mesh].unit;
  record.first = place.first;
  record.unit = static_cast<float>(unit);
  record.pad = static_cast<float>(pad_in_mesh(place.world, frame, unit, pad));
  return record;
}

StoredInstances store_instances(const Scene& scene, std::span<const MeshFaces> faces, const GridFrame& frame, double pad,
                                Conversion& conversion, const Parallel& parallel) {
  return Keeper(scene, faces, frame, pad, conversion).keep(parallel);
}

}  // namespace dmpc::core
