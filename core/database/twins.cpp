#include "core/database/twins.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace dmpc::core {
namespace {

struct Twin {
  SortedCorners corners;
  bool transmits;
  std::uint32_t id;

  bool is_like(const Twin& other) const { return transmits == other.transmits && corners == other.corners; }
  auto operator<=>(const Twin&) const = default;
};

}  // namespace

SortedCorners sorted_corners(const PrimitiveValues& triangle) {
  const auto& value = triangle.value;
  SortedCorners corners{{{value[0], value[1], value[2]}, {value[3], value[4], value[5]}, {value[6], value[7], value[8]}}};
  std::sort(corners.begin(), corners.end());
  return corners;
}

bool drop_twins(Conversion& conversion, std::span<const Material> materials) {
  std::vector<Twin> triangles;
  for (std::uint32_t id = 0; id < conversion.primitives.size(); ++id) {
    if (conversion.primitives[id].kind == PrimitiveKind::triangle) {
      const bool transmits = materials[conversion.shading[id].material()].transmittance > 0;
      triangles.push_back({sorted_corners(conversion.primitives[id]), transmits, id});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  std::vector<bool> is_twin(conversion.primitives.size());
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    is_twin[triangles[i].id] = triangles[i].is_like(triangles[i - 1]);
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
