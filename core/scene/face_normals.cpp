#include "core/scene/face_normals.h"

#include <algorithm>
#include <cstddef>

namespace dmpc::core {
namespace {

/// Twice the area times the normal.
Vec3d twice_the_area(std::span<const Vec3d> corners) {
  Vec3d sum;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum = sum + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  return sum;
}

}  // namespace

bool are_the_faces_own(std::span<const Vec3d> normals, std::span<const Vec3d> corners) {
  constexpr double sine_max = 0x1p-10;
  const Vec3d& first = normals.front();
  if (!std::all_of(normals.begin(), normals.end(), [&first](const Vec3d& v) { return v == first; })) {
    return false;
  }
  const Vec3d area = twice_the_area(corners);
  return !(length(cross(first, area)) > sine_max * length(first) * length(area));
}

}  // namespace dmpc::core
