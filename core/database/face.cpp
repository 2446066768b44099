#include "core/database/face.h"

namespace dmpc::core {
namespace {

struct Flat {
  double x, y;
};

std::array<Flat, 3> seen_along(const Face& face, std::size_t axis) {
  std::array<Flat, 3> seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = {face.corner[i][(axis + 1) % 3], face.corner[i][(axis + 2) % 3]};
  }
  return seen;
}

/// Whether an edge of `a` has all of `a` on one side and all of `b` on the other.
bool edge_separates(const std::array<Flat, 3>& a, const std::array<Flat, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Flat &from = a[i], &to = a[(i + 1) % 3], &apex = a[(i + 2) % 3];
    const double along_x = to.x - from.x, along_y = to.y - from.y;
    const auto side = [&](const Flat& point) { return along_x * (point.y - from.y) - along_y * (point.x - from.x); };
    const double inside = side(apex) < 0.0 ? -1.0 : 1.0;
    const double deepest = std::max({side(b[0]) * inside, side(b[1]) * inside, side(b[2]) * inside});
    if (deepest <= sliver * std::sqrt(along_x * along_x + along_y * along_y)) {
      return true;
    }
  }
  return false;
}

/// How high a corner of a triangle is above the plane of another one, and how far rounding may have moved it there.
struct Height {
  double height, moved;
};

/// Of the corners of the smaller one above the larger one.
std::array<Height, 3> heights_between(const Face& a, const Face& b) {
  const Face& large = a.altitude >= b.altitude ? a : b;
  const Face& small = a.altitude >= b.altitude ? b : a;
  const Vec3d middle = large.middle();
  std::array<Height, 3> heights{};
  for (std::size_t i = 0; i < 3; ++i) {
    // The larger one's own plane is turned by what rounding does to its corners.
    const double turned = 2 * length(small.corner[i] - middle) / large.altitude;
    heights[i] = {large.plane.height_of(small.corner[i]), small.moved + large.moved * (1 + turned)};
  }
  return heights;
}

}  // namespace

bool are_coplanar(const Face& a, const Face& b) {
  const std::array<Height, 3> heights = heights_between(a, b);
  return std::all_of(heights.begin(), heights.end(),
                     [](const Height& corner) { return std::fabs(corner.height) <= corner.moved; });
}

bool are_near(const Face& a, const Face& b) {
  const std::array<Height, 3> heights = heights_between(a, b);
  const double tie = tie_of(std::min(a.longest(), b.longest()));
  const auto near = [&](const Height& corner) { return near_roundings * corner.moved + tie; };
  const auto leans = [&](const Height& corner) { return std::fabs(corner.height) > leaning_nears * near(corner); };
  const auto is_above = [&](const Height& corner) { return corner.height > near(corner); };
  const auto is_below = [&](const Height& corner) { return corner.height < -near(corner); };
  return std::none_of(heights.begin(), heights.end(), leans) && !std::all_of(heights.begin(), heights.end(), is_above) &&
         !std::all_of(heights.begin(), heights.end(), is_below);
}

bool cover(const Face& a, const Face& b, std::size_t axis) {
  const std::array<Flat, 3> first = seen_along(a, axis), second = seen_along(b, axis);
  return !edge_separates(first, second) && !edge_separates(second, first);
}

bool lies_in(const Face& face, const FacePlane& plane) {
  return std::all_of(face.corner.begin(), face.corner.end(),
                     [&](const Vec3d& corner) { return std::fabs(plane.height_of(corner)) <= 4 * face.moved; });
}

}  // namespace dmpc::core
