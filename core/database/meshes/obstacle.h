// What keeps a mesh, or one of its places, from being there once: such a place has a copy.
#pragma once

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
  shining,             ///< paths aim at what shines, one by one
  numbers,             ///< a float does not hold a coordinate or a normal
  far_away,            ///< of the place: a corner where no grid has any
  smallness            ///< of the place: beside the pad boxes of it tell no rays apart
};

/// Places, by what is in their way; those that nothing is are not counted.
using ObstacleCounts = std::map<Obstacle, std::uint64_t>;
/// Counts these, too.
void add(std::span<const Obstacle> obstacles, ObstacleCounts& counts);

/// What it says of a mesh, behind "which": "shines".
const char* text_of(Obstacle obstacle);

/// The power of two above all of the mesh's coordinates; 0 if floats in units of it do not hold them.
double unit_of(const Scene& mesh);

/// Of a mesh by itself. `materials`: what its objects' indices are of.
Obstacle obstacle_of(const Scene& mesh, const std::vector<Material>& materials, const MeshFaces& faces);

/// Of each place of Scene::kept, except for smallness, which the pad decides. Those that have copies are asked, too.
std::vector<Obstacle> obstacles_of(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel);

/// Whether something is in the way in one of these places.
bool any_of(std::span<const Obstacle> obstacles);

/// The meshes of places in which something is in the way, at most three by name: "mesh 2 of 5, which shines, in 30 places".
std::string text_of(const Scene& scene, std::span<const Obstacle> obstacles);

}  // namespace dmpc::core
