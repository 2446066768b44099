#include "core/scene/base_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/ranges.h"
#include "core/record/instance.h"
#include "core/scene/placed_objects.h"
#include "core/scene/stored_objects.h"
#include "core/scene/triangulate.h"

namespace dmpc::core {
namespace {

std::span<const Vec3d> vertices_of(const Scene& scene, const Object& object) {
  return std::span(scene.vertices).subspan(object.first, object.vertex_count);
}

std::uint64_t primitives_of(const Scene& scene) {
  const std::uint64_t round = scene.spheres.size() + scene.cones.size(), polygons = scene.objects.size() - round;
  return scene.vertices.size() - 2 * polygons + round;
}

}  // namespace

bool shines(const Scene& mesh, const std::vector<Material>& materials) {
  return std::any_of(mesh.objects.begin(), mesh.objects.end(),
                     [&](const Object& object) { return materials[object.material].shines(); });
}

bool can_be_instanced(const Transform& world) {
  // Transformed normals are off by the rounding of products of two rows in double, relative to the volume that the three span.
  constexpr double share_least = 0x1p-24, size_least = 0x1p-200, size_max = 0x1p200;
  const double square = sum_over<double>(world.rows, [&](const Vec3d& row) { return dot(row, row); });
  const double size = std::sqrt(square);
  return size > size_least && size < size_max && std::fabs(world.determinant()) >= share_least * size * size * size;
}

const BaseMeshInstance* place_of(const Scene& scene, std::uint32_t object) {
  if (scene.kept == nullptr) {
    return nullptr;
  }
  const std::vector<BaseMeshInstance>& places = scene.kept->places;
  const auto behind = std::upper_bound(places.begin(), places.end(), object,
                                       [](std::uint32_t index, const BaseMeshInstance& place) { return index < place.at; });
  if (behind == places.begin()) {
    return nullptr;
  }
  const BaseMeshInstance& place = *(behind - 1);
  return place.has_copy && object - place.at < scene.kept->meshes[place.mesh].objects.size() ? &place : nullptr;
}

std::array<std::uint32_t, 3> placed_triangle(bool is_mirrored, std::uint32_t corner_count,
                                             const std::array<std::uint32_t, 3>& corners) {
  const auto placed = [&](std::size_t i) { return placed_corner(is_mirrored, corner_count, corners[i]); };
  return is_mirrored ? std::array{placed(2), placed(1), placed(0)} : corners;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const Scene& scene, std::uint32_t object) {
  const Object& copy = scene.objects[object];
  const BaseMeshInstance* const place = place_of(scene, object);
  if (place == nullptr) {
    return triangulate(vertices_of(scene, copy));
  }
  const Scene& mesh = scene.kept->meshes[place->mesh];
  auto triangles = triangulate(vertices_of(mesh, mesh.objects[object - place->at]));
  for (auto& corners : triangles) {
    corners = placed_triangle(place->world.determinant() < 0, copy.vertex_count, corners);
  }
  return triangles;
}

static_assert(beside_places_max == 1U << (3U * levels_above_instances));

InstancingShare instancing_share(const Scene& scene) {
  if (scene.stored != nullptr) {
    return scene.stored->share;
  }
  constexpr std::uint64_t corners_of_a_place = 6;
  InstancingShare share{.seen = size_with_copies(scene).vertices};
  if (scene.kept == nullptr) {
    share.stored = scene.vertices.size();
    share.own = primitives_of(scene);
    return share;
  }
  const BaseMeshes& kept = *scene.kept;
  std::vector<bool> are_instanced;
  for (const Scene& mesh : kept.meshes) {
    are_instanced.push_back(mesh.vertices.size() <= 3 * base_mesh_triangles_max && !shines(mesh, scene.materials));
    share.stored += are_instanced.back() ? mesh.vertices.size() : 0;
  }
  share.stored += scene.vertices.size();
  share.own = primitives_of(scene);
  for (const BaseMeshInstance& place : kept.places) {
    const Scene& mesh = kept.meshes[place.mesh];
    share.stored += are_instanced[place.mesh] ? corners_of_a_place : mesh.vertices.size();
    share.own += are_instanced[place.mesh] ? 0 : primitives_of(mesh);
    if (place.has_copy) {
      share.stored -= mesh.vertices.size();
      share.own -= primitives_of(mesh);
    }
  }
  share.places = kept.places.size();
  return share;
}

}  // namespace dmpc::core
