#include "core/database/faces/face.h"

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

/// The height of a triangle's corner above another triangle's plane, and the maximum displacement by rounding.
struct Height {
  double height, moved;
};

std::array<Height, 3> heights_above(const Face& base, const Face& face) {
  const Vec3d middle = base.middle();
  std::array<Height, 3> heights{};
  for (std::size_t i = 0; i < 3; ++i) {
    // Rounding of its corners turns the plane itself.
    const double turned = 2 * length(face.corner[i] - middle) / base.altitude;
    heights[i] = {base.plane.height_of(face.corner[i]), face.moved + base.moved * (1 + turned)};
  }
  return heights;
}

/// Heights of the corners of the smaller face above the larger one.
std::array<Height, 3> heights_between(const Face& a, const Face& b) {
  return a.altitude >= b.altitude ? heights_above(a, b) : heights_above(b, a);
}

bool is_on_one_side(const Face& base, const Face& face) {
  const std::array<Height, 3> heights = heights_above(base, face);
  return std::all_of(heights.begin(), heights.end(), [](const Height& corner) { return corner.height >= -corner.moved; }) ||
         std::all_of(heights.begin(), heights.end(), [](const Height& corner) { return corner.height <= corner.moved; });
}

bool have_common_corner(const Face& a, const Face& b) {
  const auto is_of_b = [&](const Vec3d& corner) {
    return std::any_of(b.corner.begin(), b.corner.end(), [&](const Vec3d& other) {
      return std::fabs(corner.x - other.x) <= corner_rounding && largest_component(corner - other) <= corner_rounding;
    });
  };
  return std::any_of(a.corner.begin(), a.corner.end(), is_of_b);
}

}  // namespace

double roundings_apart(const Face& a, const Face& b) {
  double most = 0;
  for (const Height& corner : heights_between(a, b)) {
    most = std::max(most, std::fabs(corner.height) / corner.moved);
  }
  return most;
}

bool are_leaning(const Face& a, const Face& b) {
  constexpr double seen_share = 0x1p-7;
  return !have_common_corner(a, b) && roundings_apart(a, b) * seen_share < 1 && (is_on_one_side(a, b) || is_on_one_side(b, a));
}

bool are_coplanar(const Face& a, const Face& b) {
  const std::array<Height, 3> heights = heights_between(a, b);
  return std::all_of(heights.begin(), heights.end(),
                     [](const Height& corner) { return std::fabs(corner.height) <= corner.moved; });
}

namespace {

/// are_near() with this tie.
bool lie_near(const Face& a, const Face& b, double tie) {
  const std::array<Height, 3> heights = heights_between(a, b);
  const auto near = [&](const Height& corner) { return near_roundings * corner.moved + tie; };
  const auto leans = [&](const Height& corner) { return std::fabs(corner.height) > leaning_nears * near(corner); };
  const auto is_above = [&](const Height& corner) { return corner.height > near(corner); };
  const auto is_below = [&](const Height& corner) { return corner.height < -near(corner); };
  return std::none_of(heights.begin(), heights.end(), leans) && !std::all_of(heights.begin(), heights.end(), is_above) &&
         !std::all_of(heights.begin(), heights.end(), is_below);
}

double smaller_size(const Face& a, const Face& b) { return std::min(a.longest(), b.longest()); }

}  // namespace

bool are_near(const Face& a, const Face& b) { return lie_near(a, b, tie_of(smaller_size(a, b))); }

bool are_in_reach(const Face& a, const Face& b) { return lie_near(a, b, layers_reach_of(smaller_size(a, b))); }

bool cover(const Face& a, const Face& b, std::size_t axis) {
  const std::array<Flat, 3> first = seen_along(a, axis), second = seen_along(b, axis);
  return !edge_separates(first, second) && !edge_separates(second, first);
}

bool lies_in(const Face& face, const FacePlane& plane) {
  return std::all_of(face.corner.begin(), face.corner.end(),
                     [&](const Vec3d& corner) { return std::fabs(plane.height_of(corner)) <= 4 * face.moved; });
}

}  // namespace dmpc::core
