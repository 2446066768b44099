#include "apps/lab/oracle/accurate/shared_plane.h"

#include <algorithm>
#include <cmath>

namespace dmpc::apps {
namespace {

using Vec3l = core::Vec3<long double>;

/// Of a coordinate: a double is off by 2^-53 of it, what was turned and moved some times as much.
constexpr long double corner_rounding = 0x1p-51L;

struct Leaf {
  explicit Leaf(const AccurateBody& body)
      : corner{Vec3l(body.place[0]), Vec3l(body.place[1]), Vec3l(body.place[2])},
        area(cross(corner[1] - corner[0], corner[2] - corner[0])),
        normal(normalize(area)) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, length(corner[(k + 1) % 3] - corner[k]));
      moved = std::max(moved, corner_rounding * dot_of_magnitudes(normal, corner[k]));
    }
  }

  long double height() const { return length(area) / longest; }

  std::array<Vec3l, 3> corner;
  Vec3l area, normal;
  long double longest = 0;
  long double moved = 0;  ///< how far rounding moves a corner across the plane
};

}  // namespace

bool share_plane(const AccurateScene& scene, std::uint32_t a, std::uint32_t b) {
  const AccurateBody &first = scene.bodies[a], &second = scene.bodies[b];
  if (first.kind != core::PrimitiveKind::triangle || second.kind != core::PrimitiveKind::triangle) {
    return false;
  }
  const Leaf one(first), other(second);
  const Leaf& large = one.height() >= other.height() ? one : other;
  const Leaf& small = one.height() >= other.height() ? other : one;
  return std::all_of(small.corner.begin(), small.corner.end(), [&](const Vec3l& corner) {
    const Vec3l off = corner - large.corner[0];
    const long double moved = corner_rounding * dot_of_magnitudes(large.normal, corner);
    return std::fabs(dot(off, large.normal)) <= moved + large.moved * (1 + length(off) / large.height());
  });
}

}  // namespace dmpc::apps
