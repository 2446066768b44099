#include "core/database/twins.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/database/exact_corners.h"
#include "core/database/face.h"

namespace dmpc::core {
namespace {

struct Twin {
  SortedCorners corners;
  bool transmits;
  std::uint32_t id;

  bool is_like(const Twin& other) const { return transmits == other.transmits && corners == other.corners; }
  auto operator<=>(const Twin&) const = default;
};

/// Finds, among triangles with the same floats, those in whose plane an earlier one lies for doubles.
class TwinFinder {
 public:
  TwinFinder(const Scene& scene, const GridFrame& frame, const Conversion& conversion)
      : scene_(scene), frame_(frame), conversion_(conversion) {}

  /// Marks them. `like`: the triangles, ascending.
  void mark(std::span<const std::uint32_t> like, std::vector<bool>& is_twin) {
    kept_.clear();
    while (!like.empty()) {
      const std::size_t count = std::min(like.size(), faces_together);
      for (const Face& face : exact_faces(scene_, frame_, conversion_, like.first(count))) {
        is_twin[face.id] = is_kept(face);
      }
      like = like.subspan(count);
    }
  }

 private:
  static constexpr std::size_t faces_together = 1024, kept_max = 64;

  /// Whether one like it is; else it is from now on.
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
  std::vector<Face> kept_;
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
    if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
      const bool transmits = scene.materials[conversion.shading[id].material()].transmittance > 0;
      triangles.push_back({sorted_corners(conversion.primitives[id]), transmits, id});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<bool> is_twin(conversion.primitives.size());
  TwinFinder finder(scene, frame, conversion);
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last) {
    std::vector<std::uint32_t> like;
    for (last = first; last < triangles.size() && triangles[last].is_like(triangles[first]); ++last) {
      like.push_back(triangles[last].id);
    }
    if (like.size() > 1) {
      finder.mark(like, is_twin);
    }
  }
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
