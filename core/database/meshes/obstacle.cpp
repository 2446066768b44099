#include "core/database/meshes/obstacle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "core/base/box.h"
#include "core/database/conversion.h"
#include "core/database/meshes/mesh_faces.h"
#include "core/database/parallel.h"
#include "core/scene/base_meshes.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// The limit for a mesh's largest coordinate: records, in units of it, then keep all bits of floats.
constexpr int exponent_max = 100;
/// Instances that one thread takes at a time.
constexpr std::size_t places_a_part = 64;
constexpr std::size_t meshes_named = 3;
static_assert(base_mesh_triangles_max == 2'097'152, "text_of() says it");

bool is_in_float(double value) { return double{static_cast<float>(value)} == value; }
bool is_in_floats(const Vec3d& v) { return is_in_float(v.x) && is_in_float(v.y) && is_in_float(v.z); }

bool has_normals_in_floats(const Scene& mesh) {
  return std::all_of(mesh.normals.begin(), mesh.normals.end(), is_in_floats) &&
         std::all_of(mesh.corners.begin(), mesh.corners.end(),
                     [](const TexturedCorner& corner) { return is_in_floats(corner.normal); });
}

/// Few meshes have to be tested corner by corner.
bool is_within_grids(const Scene& mesh, const Box& box, const Transform& world) {
  const Box reach = reach_of(box, world);
  return (usable(reach.low) && usable(reach.high)) ||
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [&](const Vec3d& vertex) { return usable(world.point(vertex)); });
}

}  // namespace

void add(std::span<const Obstacle> obstacles, ObstacleCounts& counts) {
  for (const Obstacle obstacle : obstacles) {
    if (obstacle != Obstacle::none) {
      ++counts[obstacle];
    }
  }
}

const char* text_of(Obstacle obstacle) {
  switch (obstacle) {
    case Obstacle::none:
      break;
    case Obstacle::no_triangle:
      return "has no triangle with an area";
    case Obstacle::too_many_triangles:
      return "has more than 2,097,152 triangles";
    case Obstacle::shining:
      return "shines";
    case Obstacle::numbers:
      return "has numbers that no float holds";
    case Obstacle::far_away:
      return "reaches too far out";
    case Obstacle::smallness:
      return "is too small beside the scene";
  }
  return "can be kept";
}

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

Obstacle obstacle_of(const Scene& mesh, const std::vector<Material>& materials, const MeshFaces& faces) {
  if (faces.triangles.empty()) {
    return Obstacle::no_triangle;
  }
  if (faces.triangles.size() > base_mesh_triangles_max) {
    return Obstacle::too_many_triangles;
  }
  if (shines(mesh, materials)) {
    return Obstacle::shining;
  }
  return unit_of(mesh) == 0 || !has_normals_in_floats(mesh) ? Obstacle::numbers : Obstacle::none;
}

std::vector<Obstacle> obstacles_of(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel) {
  if (scene.kept == nullptr) {
    return {};
  }
  const BaseMeshes& kept = *scene.kept;
  std::vector<Obstacle> of_meshes(kept.meshes.size());
  std::vector<Box> boxes(kept.meshes.size());
  parallel.for_each(kept.meshes.size(), [&](std::size_t i) {
    of_meshes[i] = obstacle_of(kept.meshes[i], scene.materials, faces[i]);
    boxes[i] = Box::around(kept.meshes[i].vertices);
  });
  std::vector<Obstacle> obstacles(kept.places.size());
  parallel.for_each_run(kept.places.size(), places_a_part, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const BaseMeshInstance& place = kept.places[i];
      obstacles[i] = of_meshes[place.mesh];
      if (obstacles[i] == Obstacle::none && !is_within_grids(kept.meshes[place.mesh], boxes[place.mesh], place.world)) {
        obstacles[i] = Obstacle::far_away;
      }
    }
  });
  return obstacles;
}

bool any_of(std::span<const Obstacle> obstacles) {
  return std::any_of(obstacles.begin(), obstacles.end(), [](Obstacle obstacle) { return obstacle != Obstacle::none; });
}

std::string text_of(const Scene& scene, std::span<const Obstacle> obstacles) {
  const BaseMeshes& kept = *scene.kept;
  std::vector<std::uint64_t> places(kept.meshes.size());
  std::vector<Obstacle> first(kept.meshes.size());
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (const std::uint32_t mesh = kept.places[i].mesh; obstacles[i] != Obstacle::none && places[mesh]++ == 0) {
      first[mesh] = obstacles[i];
    }
  }
  std::string text;
  std::size_t named = 0;
  for (std::size_t mesh = 0; mesh < places.size(); ++mesh) {
    if (places[mesh] > 0 && ++named <= meshes_named) {
      text += (text.empty() ? "mesh " : ", mesh ") + std::to_string(mesh + 1) + " of " + std::to_string(places.size()) +
              ", which " + text_of(first[mesh]) + ", in " + std::to_string(places[mesh]) +
              (places[mesh] == 1 ? " place" : " places");
    }
  }
  return named > meshes_named ? text + ", and " + std::to_string(named - meshes_named) + " more" : text;
}

}  // namespace dmpc::core
