#include "core/database/meshes/copies_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/units.h"
#include "core/scene/base_meshes.h"
#include "core/scene/frame.h"
#include "core/scene/placed_objects.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// Instances in one thread's chunk.
constexpr std::size_t places_a_chunk = 256;

bool is_below(const Vec3d& v, double coordinate_max) {
  return std::fabs(v.x) < coordinate_max && std::fabs(v.y) < coordinate_max && std::fabs(v.z) < coordinate_max;
}

/// Boxes of a mesh, in its own coordinates.
struct MeshBoxes {
  Box all;
  std::size_t run = 1;    ///< the number of consecutive vertices in a box
  std::vector<Box> runs;  ///< about as many as a run has vertices

  explicit MeshBoxes(const std::vector<Vec3d>& vertices) : all(Box::around(vertices)) {
    run += static_cast<std::size_t>(std::sqrt(static_cast<double>(vertices.size())));
    for (std::size_t first = 0; first < vertices.size(); first += run) {
      runs.push_back(Box::around(std::span(vertices).subspan(first, std::min(run, vertices.size() - first))));
    }
  }
};

class CopiesBounds {
 public:
  CopiesBounds(const BaseMeshes& kept, double coordinate_max) : kept_(kept), coordinate_max_(coordinate_max) {
    for (const Scene& mesh : kept.meshes) {
      own_.emplace_back(mesh.vertices);
    }
  }

  /// Instances that may reach farthest to each side come first, so that most of the others lie within the result.
  void include_all(Box& box, const Parallel& parallel) const {
    for (const std::size_t place : farthest()) {
      include(box, kept_.places[place]);
    }
    std::vector<Box> boxes(ceil_divide(kept_.places.size(), places_a_chunk), box);
    parallel.for_each_run(kept_.places.size(), places_a_chunk, [&](std::size_t first, std::size_t end) {
      Box& reached = boxes[first / places_a_chunk];
      for (std::size_t i = first; i < end; ++i) {
        if (!holds(reached, reach(kept_.places[i]))) {
          include(reached, kept_.places[i]);
        }
      }
    });
    for (const Box& one : boxes) {
      if (!one.empty()) {
        box.include(one.low);
        box.include(one.high);
      }
    }
  }

 private:
  static bool holds(const Box& box, const Box& reach) { return box.holds(reach.low) && box.holds(reach.high); }
  Box reach(const BaseMeshInstance& place) const { return reach_of(own_[place.mesh].all, place.world); }

  /// The farthest instances to each side of each axis.
  std::vector<std::size_t> farthest() const {
    std::vector<std::size_t> places(6);
    Box known;
    for (std::size_t i = 0; i < kept_.places.size(); ++i) {
      const Box reach = this->reach(kept_.places[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (reach.low[axis] < known.low[axis]) {
          known.low[axis] = reach.low[axis];
          places[2 * axis] = i;
        }
        if (reach.high[axis] > known.high[axis]) {
          known.high[axis] = reach.high[axis];
          places[2 * axis + 1] = i;
        }
      }
    }
    return places;
  }

  /// Includes the corners of the runs whose boxes extend beyond the result.
  void include(Box& box, const BaseMeshInstance& place) const {
    const std::vector<Vec3d>& vertices = kept_.meshes[place.mesh].vertices;
    const MeshBoxes& own = own_[place.mesh];
    for (std::size_t i = 0; i < own.runs.size(); ++i) {
      if (!holds(box, reach_of(own.runs[i], place.world))) {
        include(box, place.world, std::span(vertices).subspan(i * own.run, std::min(own.run, vertices.size() - i * own.run)));
      }
    }
  }
  void include(Box& box, const Transform& world, std::span<const Vec3d> vertices) const {
    for (const Vec3d& vertex : vertices) {
      const Vec3d corner = world.point(vertex);
      if (is_below(corner, coordinate_max_)) {
        box.include(corner);
      }
    }
  }

  const BaseMeshes& kept_;
  double coordinate_max_;
  std::vector<MeshBoxes> own_;  ///< by mesh
};

}  // namespace

void include_copies(Box& box, const Scene& scene, double coordinate_max, const Parallel& parallel) {
  if (leaves_copies_out(scene)) {
    CopiesBounds(*scene.kept, coordinate_max).include_all(box, parallel);
  }
}

}  // namespace dmpc::core
