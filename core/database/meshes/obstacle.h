// Obstacles to storing a mesh once, or to one of its instances: such an instance has a copy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace dmpc::core {

struct MeshFaces;
class Parallel;

enum class Obstacle : std::uint8_t {
  none,
  no_triangle,         ///< the mesh has none with an area
  too_many_triangles,  ///< more than base_mesh_triangles_max
  shining,             ///< an emitter: light sampling selects its triangles one by one
  numbers,             ///< a float does not hold a coordinate or a normal
  far_away,            ///< for an instance: a corner beyond any grid
  smallness            ///< for an instance: its boxes are too small beside the pad to tell rays apart
};
inline constexpr std::size_t obstacle_count = 7;

/// Number of instances by obstacle; those without are not counted.
using ObstacleCounts = std::map<Obstacle, std::uint64_t>;
/// Adds to the counts.
void add(std::span<const Obstacle> obstacles, ObstacleCounts& counts);

/// The obstacle as a predicate, to follow "which": "shines".
const char* text_of(Obstacle obstacle);

/// The power of two above all of the mesh's coordinates; 0 if they are not exact in floats in units of it.
double unit_of(const Scene& mesh);

/// For a mesh by itself. `materials`: those of its objects' indices.
Obstacle obstacle_of(const Scene& mesh, const std::vector<Material>& materials, const MeshFaces& faces);

/// For each instance of Scene::kept, without smallness, which depends on the pad. Includes those that have copies.
std::vector<Obstacle> obstacles_of(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel);

/// Whether one of these instances has an obstacle.
bool any_of(std::span<const Obstacle> obstacles);

/// The meshes of instances with obstacles, at most three by name: "mesh 2 of 5, which shines, in 30 places".
std::string text_of(const Scene& scene, std::span<const Obstacle> obstacles);

}  // namespace dmpc::core
