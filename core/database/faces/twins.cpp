#include "core/database/faces/twins.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/database/faces/exact_corners.h"
#include "core/database/faces/face.h"
#include "core/scene/base_meshes.h"

namespace dmpc::core {
namespace {

struct Twin {
  SortedCorners corners;
  int rank;
  std::uint32_t id;

  bool is_like(const Twin& other) const { return rank == other.rank && corners == other.corners; }
  auto operator<=>(const Twin&) const = default;
};

/// Finds triangles with the same floats as an earlier one in whose plane they lie in double. Many are processed together, so that
/// polygons with twins of each other are triangulated once for all of them.
class TwinFinder {
 public:
  TwinFinder(const Scene& scene, const GridFrame& frame, const Conversion& conversion, std::vector<bool>& is_twin)
      : scene_(scene), frame_(frame), conversion_(conversion), is_twin_(is_twin) {}

  /// `like`: triangles with the same floats, ascending.
  void add(std::span<const std::uint32_t> like) {
    for (const std::uint32_t id : like) {
      ids_.push_back(id);
      is_first_.push_back(id == like[0]);
      if (ids_.size() == together_max) {
        mark();
      }
    }
  }
  /// Marks all triangles that were added.
  void mark() {
    std::vector<std::uint32_t> sorted = ids_;
    std::sort(sorted.begin(), sorted.end());
    const std::vector<Face> faces = exact_faces(scene_, frame_, conversion_, sorted);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (is_first_[i]) {
        kept_.clear();
      }
      const auto place = std::lower_bound(sorted.begin(), sorted.end(), ids_[i]) - sorted.begin();
      is_twin_[ids_[i]] = is_kept(faces[static_cast<std::size_t>(place)]);
    }
    ids_.clear();
    is_first_.clear();
  }

 private:
  static constexpr std::size_t together_max = 65536, kept_max = 64;

  /// Whether an equal face is kept; if not, this one is from now on.
  bool is_kept(const Face& face) {
    const bool found = std::any_of(kept_.begin(), kept_.end(), [&](const Face& other) { return are_coplanar(face, other); });
    if (!found && kept_.size() < kept_max) {
      kept_.push_back(face);
    }
    return found;
  }

  const Scene& scene_;
  const GridFrame& frame_;
  const Conversion& conversion_;
  std::vector<bool>& is_twin_;
  std::vector<std::uint32_t> ids_;
  std::vector<bool> is_first_;  ///< among equal faces
  std::vector<Face> kept_;      ///< one for each set of equal faces
};

}  // namespace

SortedCorners sorted_corners(const PrimitiveValues& triangle) {
  const auto& value = triangle.value;
  SortedCorners corners{{{value[0], value[1], value[2]}, {value[3], value[4], value[5]}, {value[6], value[7], value[8]}}};
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool drop_twins(Conversion& conversion, const Scene& scene, const GridFrame& frame) {
  std::vector<Twin> triangles;
  for (std::uint32_t id = 0; id < conversion.primitives.size(); ++id) {
    if (conversion.primitives[id].kind == PrimitiveKind::triangle && place_of(scene, conversion.sources[id].object) == nullptr) {
      const int rank = scene.materials[conversion.shading[id].material()].rank_in_plane();
      triangles.push_back({sorted_corners(conversion.primitives[id]), rank, id});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<bool> is_twin(conversion.primitives.size());
  TwinFinder finder(scene, frame, conversion, is_twin);
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last) {
    std::vector<std::uint32_t> like;
    for (last = first; last < triangles.size() && triangles[last].is_like(triangles[first]); ++last) {
      like.push_back(triangles[last].id);
    }
    if (like.size() > 1) {
      finder.add(like);
    }
  }
  finder.mark();
  std::vector<std::uint32_t> kept(conversion.primitives.size());
  std::iota(kept.begin(), kept.end(), 0U);
  std::erase_if(kept, [&](std::uint32_t id) { return is_twin[id]; });
  const std::size_t count = conversion.primitives.size() - kept.size();
  if (count > 0) {
    rearrange(conversion, kept);
    conversion.duplicates += static_cast<std::uint32_t>(count);
  }
  return count > 0;
}

}  // namespace dmpc::core
