#include "apps/lab/oracle/accurate/shared_plane.h"

#include <algorithm>
#include <cmath>

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr double corner_rounding = 0x1p-24;
/// The product's coordinates begin so far before the scene, in sizes of it.
constexpr double margin_of_grid = 0.02;

struct Leaf {
  explicit Leaf(const AccurateBody& body)
      : corner(body.place), area(cross(corner[1] - corner[0], corner[2] - corner[0])), normal(normalize(area)) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, length(corner[(k + 1) % 3] - corner[k]));
    }
  }

  double height() const { return length(area) / longest; }

  std::array<Vec3d, 3> corner;
  Vec3d area, normal;
  double longest = 0;
};

/// How far rounding moves a point of the scene across a plane.
double moved(const AccurateScene& scene, const Vec3d& point, const Vec3d& normal) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum += std::fabs(normal[axis]) * (point[axis] - scene.bounds.low[axis] + margin_of_grid * scene.size);
  }
  return corner_rounding * sum;
}

}  // namespace

bool share_plane(const AccurateScene& scene, std::uint32_t a, std::uint32_t b) {
  const AccurateBody &first = scene.bodies[a], &second = scene.bodies[b];
  if (first.kind != core::PrimitiveKind::triangle || second.kind != core::PrimitiveKind::triangle) {
    return false;
  }
  const Leaf one(first), other(second);
  const Leaf& large = one.height() >= other.height() ? one : other;
  const Leaf& small = one.height() >= other.height() ? other : one;
  return std::all_of(small.corner.begin(), small.corner.end(), [&](const Vec3d& corner) {
    const Vec3d off = corner - large.corner[0];
    return std::fabs(dot(off, large.normal)) <= moved(scene, corner, large.normal) * (1 + length(off) / large.height());
  });
}

}  // namespace dmpc::apps
