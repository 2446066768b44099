#include "core/database/meshes/uncopied_instances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "core/database/grid/macro_cells.h"
#include "core/record/coordinate.h"
#include "core/scene/frame.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// Instances that one thread takes at a time.
constexpr std::size_t places_together = 64;
/// Triangles counted between tests of the sum.
constexpr std::size_t places_a_group = 4096;
/// Copies of more triangles would need records of more than 16 GiB.
constexpr std::uint64_t copied_triangles_end = std::uint64_t{1} << 28U;
/// Ids from here on belong to no primitive; the range has space for those of the instances' boxes.
constexpr std::uint64_t ids_max = 0xf0000000U;

void check_ids(std::uint64_t count) {
  if (count > ids_max) {
    throw CapacityError("with all places of meshes it has up to " + std::to_string(count) +
                        " primitives, and a database counts up to " + std::to_string(ids_max) + ": leave some of them out");
  }
}

/// A box that contains the copies of a box's corners, grid-local, as floats: rounding keeps their order.
Box local_reach(const Box& own, const BaseMeshInstance& place, const GridFrame& frame) {
  const Box reach = reach_of(own, place.world);
  return {Vec3d(coordinates_of((reach.low - frame.origin) * frame.scale)),
          Vec3d(coordinates_of((reach.high - frame.origin) * frame.scale))};
}

template <class Part>
void for_each_place(std::size_t count, const Parallel& parallel, const Part& part) {
  parallel.for_each_run(count, places_together, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      part(i);
    }
  });
}

}  // namespace

UncopiedInstances::UncopiedInstances(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel)
    : scene_(scene), faces_(faces) {
  std::vector<bool> is_left_out;
  for (const BaseMeshInstance& place : scene.kept->places) {
    is_left_out.push_back(!place.has_copy);
    if (!place.has_copy) {
      instances_.push_back(place);
      triangles_ += triangles_of(place);
    }
  }
  check_ids(triangles_ + 2 * scene.objects.size());
  meshes_ = records_of(scene, faces, is_left_out, parallel);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (meshes_.index[i] != MeshesRecords::nowhere) {
      chunks_.push_back(chunks_of(i));
    }
  }
}

/// Smaller groups have tighter boxes, but there are more of them. 128 triangles fit well; a large mesh, which has few instances,
/// has as many groups as a group has triangles.
std::vector<UncopiedInstances::Chunk> UncopiedInstances::chunks_of(std::size_t mesh) const {
  const std::vector<std::uint32_t>& ids = meshes_.records[meshes_.index[mesh]].tree.ids;
  const auto root = static_cast<std::size_t>(std::sqrt(static_cast<double>(ids.size())));
  const std::size_t step = std::max(std::size_t{16}, std::min(ids.size() / 128, root));
  std::vector<Chunk> chunks;
  for (std::size_t first = 0; first < ids.size(); first += step) {
    const auto some = std::span(ids).subspan(first, std::min(step, ids.size() - first));
    Chunk& chunk = chunks.emplace_back(Chunk{{}, {some.begin(), some.end()}});
    for (const std::uint32_t id : some) {
      const MeshTriangle& triangle = faces_[mesh].triangles[id];
      for (const std::uint32_t corner : triangle.corner) {
        const Scene& own = scene_.kept->meshes[mesh];
        chunk.box.include(own.vertices[own.objects[triangle.object].first + corner]);
      }
    }
  }
  return chunks;
}

/// Long triangles touch so many cells that counting all of them would take minutes. In parallel each instance is counted up to
/// its share of the bound; one that has more is then counted by itself, so counting stops where the total is too large.
std::int64_t UncopiedInstances::excess(const GridFrame& frame, double pad, std::uint64_t listed, bool is_exact,
                                       const Parallel& parallel) const {
  if (triangles_ > copied_triangles_end) {
    return 0;
  }
  const std::uint64_t touches_max = MacroCells::touches_max(triangles_, listed);
  const std::size_t group = std::min(places_a_group, instances_.size());
  Touches all;
  std::vector<Touches> some(group);
  for (std::size_t first = 0; first < instances_.size(); first += group) {
    const std::size_t count = std::min(group, instances_.size() - first);
    const std::uint64_t share = touches_max / group;
    for_each_place(count, parallel,
                   [&](std::size_t i) { some[i] = touches_of(instances_[first + i], frame, pad, share, is_exact); });
    for (std::size_t i = 0; i < count; ++i) {
      const Touches here =
          some[i].touches <= share ? some[i] : touches_of(instances_[first + i], frame, pad, touches_max - all.touches, is_exact);
      all.triangles += here.triangles;
      all.touches += here.touches;
      if (all.touches > touches_max) {
        return excess_without_list;
      }
    }
  }
  return MacroCells::excess_of(all.touches, all.triangles);
}

/// An instance in one cell has no excess, however it is rounded.
UncopiedInstances::Touches UncopiedInstances::touches_of(const BaseMeshInstance& place, const GridFrame& frame, double pad,
                                                         std::uint64_t touches_max, bool is_exact) const {
  const Scene& mesh = scene_.kept->meshes[place.mesh];
  const Placing placing(place.world, frame);
  const bool is_mirrored = placing.is_mirrored();
  std::vector<PrimitiveValues> copies;
  for (const Chunk& chunk : chunks_[index_of(place)]) {
    if (!is_exact && MacroCells::is_within_one(local_reach(chunk.box, place, frame), frame, pad)) {
      continue;
    }
    for (const std::uint32_t id : chunk.triangles) {
      const MeshTriangle& triangle = faces_[place.mesh].triangles[id];
      PrimitiveValues copy{.kind = PrimitiveKind::triangle};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t corner = mesh.objects[triangle.object].first + triangle.corner[is_mirrored ? 2 - k : k];
        const Vec3f at = coordinates_of(placing.corner(mesh.vertices[corner]));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          copy.value[3 * k + axis] = at[axis];
        }
      }
      if (!leaves_nothing({copy.vector(0), copy.vector(3), copy.vector(6)})) {
        copies.push_back(copy);
      }
    }
  }
  return {copies.size(), MacroCells::touches_of(copies, frame, pad, touches_max)};
}

std::vector<Obstacle> UncopiedInstances::obstacles(const GridFrame& frame, double pad) const {
  std::vector<Obstacle> obstacles;
  for (const BaseMeshInstance& place : scene_.kept->places) {
    const bool may_stay = place.has_copy || can_have_boxes(place.world, frame, meshes_.records[index_of(place)].unit, pad);
    obstacles.push_back(may_stay ? Obstacle::none : Obstacle::smallness);
  }
  return obstacles;
}

StoredInstances UncopiedInstances::keep(const GridFrame& frame, double pad, Conversion& conversion, const Parallel& parallel) {
  expect(!any_of(obstacles(frame, pad)), "a place that is too small has a copy");
  check_ids(conversion.sources.size() + triangles_);
  StoredInstances kept;
  std::vector<std::uint32_t> own;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < conversion.sources.size(); ++i) {
    if (conversion.sources[i].object == source_is_place) {
      const BaseMeshInstance& place = instances_[kept.places.size()];
      kept.places.push_back({place.world, index_of(place), next, {}});
      next += static_cast<std::uint32_t>(triangles_of(place));
    } else {
      kept.own_ids.push_back(static_cast<std::uint32_t>(own.size()));
      kept.reported.push_back(next++);
      own.push_back(i);
    }
  }
  for_each_place(instances_.size(), parallel, [&](std::size_t i) { kept.places[i].bounds = bounds_of(instances_[i], frame); });
  rearrange(conversion, own);
  kept.unlisted = triangles_;
  kept.meshes = std::move(meshes_.records);
  return kept;
}

Bounds UncopiedInstances::bounds_of(const BaseMeshInstance& place, const GridFrame& frame) const {
  Box box;
  for (const Chunk& chunk : chunks_[index_of(place)]) {
    const Box reach = local_reach(chunk.box, place, frame);
    box.include(reach.low);
    box.include(reach.high);
  }
  return Bounds::around(box);
}

}  // namespace dmpc::core
