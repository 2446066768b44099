#include "core/database/left_out_places.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/base/units.h"
#include "core/database/top_cells.h"
#include "core/database/usable_place.h"
#include "core/record/coordinate.h"
#include "core/record/vanishing.h"
#include "core/scene/frame.h"
#include "core/scene/place_reach.h"
#include "core/scene/placing.h"

namespace dmpc::core {
namespace {

/// Places that one thread takes at a time.
constexpr std::size_t places_together = 64;
/// Copies of more triangles would be records of more than 16 GiB.
constexpr std::uint64_t copied_triangles_end = std::uint64_t{1} << 28U;
/// Ids that are no primitive's, and those of the boxes of places, have room behind.
constexpr std::uint64_t ids_max = 0xf0000000U;

/// What the copies of a box's corners are within, grid-local, as floats have them: rounding keeps their order.
Box local_reach(const Box& own, const KeptPlace& place, const GridFrame& frame) {
  const Box reach = reach_of(own, place.world, frame.axes);
  return {Vec3d(coordinates_of((reach.low - frame.origin) * frame.scale)),
          Vec3d(coordinates_of((reach.high - frame.origin) * frame.scale))};
}

template <class Part>
void for_each_place(const std::vector<KeptPlace>& places, const Parallel& parallel, const Part& part) {
  parallel.for_each(ceil_divide(places.size(), places_together), [&](std::size_t chunk) {
    const std::size_t end = std::min(places.size(), (chunk + 1) * places_together);
    for (std::size_t i = chunk * places_together; i < end; ++i) {
      part(i);
    }
  });
}

}  // namespace

std::optional<LeftOutPlaces> LeftOutPlaces::of(const Scene& scene, std::span<const MeshFaces> faces, const Parallel& parallel) {
  LeftOutPlaces places(scene, faces);
  for (const KeptPlace& place : scene.kept->places) {
    places.triangles_ += places.triangles_of(place);
  }
  if (places.triangles_ + 2 * scene.objects.size() > ids_max) {
    throw RoomError("all places of meshes have " + std::to_string(places.triangles_) +
                    " triangles, and a database counts up to " + std::to_string(ids_max) + ": leave some of them out");
  }
  return places.take_meshes(parallel) && places.are_usable(parallel) ? std::optional(std::move(places)) : std::nullopt;
}

bool LeftOutPlaces::take_meshes(const Parallel& parallel) {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Scene& mesh = scene_.kept->meshes[i];
    auto records = records_of(mesh, scene_.materials, faces_[i], parallel);
    if (!records) {
      return false;
    }
    chunks_.emplace_back(mesh, faces_[i], records->tree.ids);
    records_.push_back(std::move(*records));
  }
  return true;
}

bool LeftOutPlaces::are_usable(const Parallel& parallel) const {
  const std::vector<KeptPlace>& places = scene_.kept->places;
  std::vector<std::uint8_t> is_usable(places.size());
  for_each_place(places, parallel, [&](std::size_t i) { is_usable[i] = this->is_usable(places[i]) ? 1 : 0; });
  return std::all_of(is_usable.begin(), is_usable.end(), [](std::uint8_t is) { return is != 0; });
}

bool LeftOutPlaces::is_usable(const KeptPlace& place) const {
  const Box reach = reach_of(chunks_[place.mesh].box(), place.world);
  const auto& vertices = scene_.kept->meshes[place.mesh].vertices;
  return (usable(reach.low) && usable(reach.high)) ||
         std::all_of(vertices.begin(), vertices.end(), [&](const Vec3d& vertex) { return usable(place.world.point(vertex)); });
}

std::int64_t LeftOutPlaces::excess(const GridFrame& frame, double pad, bool is_exact, const Parallel& parallel) const {
  if (triangles_ > copied_triangles_end) {
    return 0;
  }
  const std::vector<KeptPlace>& places = scene_.kept->places;
  std::vector<std::int64_t> excess(places.size());
  for_each_place(places, parallel, [&](std::size_t i) { excess[i] = excess_of(places[i], frame, pad, is_exact); });
  std::int64_t sum = 0;
  for (const std::int64_t one : excess) {
    sum += one;
  }
  return sum;
}

/// What lies in one cell has no excess, however it is rounded.
std::int64_t LeftOutPlaces::excess_of(const KeptPlace& place, const GridFrame& frame, double pad, bool is_exact) const {
  const Scene& mesh = scene_.kept->meshes[place.mesh];
  const MeshChunks& chunks = chunks_[place.mesh];
  const Placing placing(place.world, frame);
  const bool is_mirrored = placing.is_mirrored();
  std::vector<PrimitiveValues> copies;
  for (const MeshChunks::Chunk& chunk : chunks.chunks()) {
    if (!is_exact && TopCells::is_within_one(local_reach(chunk.box, place, frame), frame, pad)) {
      continue;
    }
    for (const std::uint32_t id : chunks.ids(chunk)) {
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
  return TopCells::excess_of(copies, frame, pad);
}

std::optional<KeptInstances> LeftOutPlaces::keep(const GridFrame& frame, double pad, Conversion& conversion,
                                                 const Parallel& parallel) {
  const std::vector<KeptPlace>& places = scene_.kept->places;
  if (!std::all_of(places.begin(), places.end(),
                   [&](const KeptPlace& place) { return can_have_boxes(place.world, frame, records_[place.mesh].unit, pad); })) {
    return std::nullopt;
  }
  KeptInstances kept;
  std::vector<std::uint32_t> own;
  if (conversion.sources.size() + triangles_ > ids_max) {
    throw RoomError("it has " + std::to_string(conversion.sources.size() + triangles_) +
                    " primitives with all places of meshes, and a database counts up to " + std::to_string(ids_max) +
                    ": leave some of them out");
  }
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < conversion.sources.size(); ++i) {
    if (conversion.sources[i].object == source_is_place) {
      const KeptPlace& place = places[kept.places.size()];
      kept.places.push_back({place.world, place.mesh, next, {}});
      next += static_cast<std::uint32_t>(triangles_of(place));
    } else {
      kept.own_ids.push_back(static_cast<std::uint32_t>(own.size()));
      kept.told.push_back(next++);
      own.push_back(i);
    }
  }
  for_each_place(places, parallel, [&](std::size_t i) { kept.places[i].bounds = bounds_of(places[i], frame); });
  rearrange(conversion, own);
  kept.triangles = triangles_;
  kept.meshes = std::move(records_);
  return kept;
}

Bounds LeftOutPlaces::bounds_of(const KeptPlace& place, const GridFrame& frame) const {
  Box box;
  for (const MeshChunks::Chunk& chunk : chunks_[place.mesh].chunks()) {
    const Box reach = local_reach(chunk.box, place, frame);
    box.include(reach.low);
    box.include(reach.high);
  }
  return Bounds::around(box);
}

}  // namespace dmpc::core
