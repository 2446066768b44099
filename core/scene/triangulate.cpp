#include "core/scene/triangulate.h"

#include <cmath>
#include <numeric>

namespace dmpc::core {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Twice the area, as a vector along the normal (Newell's method).
Vec3d area_vector(std::span<const Vec3d> vertices) {
  Vec3d sum;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    sum = sum + cross(vertices[i] - vertices[0], vertices[(i + 1) % vertices.size()] - vertices[0]);
  }
  return sum;
}

/// A polygon seen along its normal's largest axis, counter-clockwise.
class Projection {
 public:
  Projection(std::span<const Vec3d> vertices, const Vec3d& normal) : vertices_(vertices) {
    const Vec3d size{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
    const std::size_t axis = size.x >= size.y ? (size.x >= size.z ? 0U : 2U) : (size.y >= size.z ? 1U : 2U);
    u_ = (axis + 1) % 3;
    v_ = (axis + 2) % 3;
    sign_ = normal[axis] < 0 ? -1.0 : 1.0;
  }
  /// Above 0 if a, b, c turn left.
  double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3d ab = vertices_[b] - vertices_[a], ac = vertices_[c] - vertices_[a];
    return sign_ * (ab[u_] * ac[v_] - ab[v_] * ac[u_]);
  }
  bool contains(const Triangle& t, std::uint32_t p) const {
    return turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
  }
  bool same_place(std::uint32_t a, std::uint32_t b) const { return vertices_[a] == vertices_[b]; }

 private:
  std::span<const Vec3d> vertices_;
  std::size_t u_, v_;
  double sign_;
};

bool is_fan(const Projection& seen, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (seen.turn(i, (i + 1) % count, (i + 2) % count) < 0) {
      return false;
    }
  }
  // Every corner turns left, but a star may go round twice: then the fan has a triangle that turns right. Nor does a fan do where
  // a corner lies on a straight edge: a triangle without area would be dropped and leave a crack.
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    if (!(seen.turn(0, i, i + 1) > 0)) {
      return false;
    }
  }
  return true;
}

bool is_ear(const Projection& seen, const std::vector<std::uint32_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Triangle ear{ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]};
  if (!(seen.turn(ear[0], ear[1], ear[2]) > 0)) {
    return false;
  }
  for (const std::uint32_t p : ring) {
    const bool corner = seen.same_place(p, ear[0]) || seen.same_place(p, ear[1]) || seen.same_place(p, ear[2]);
    if (!corner && seen.contains(ear, p)) {
      return false;
    }
  }
  return true;
}

/// An ear, or, where rounding or self-intersection leaves none, the corner that turns left most: the rest goes on.
std::size_t find_ear(const Projection& seen, const std::vector<std::uint32_t>& ring) {
  const std::size_t n = ring.size();
  std::size_t best = 0;
  double best_turn = -1;
  for (std::size_t at = 0; at < n; ++at) {
    if (is_ear(seen, ring, at)) {
      return at;
    }
    const double turn = seen.turn(ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]);
    if (turn > best_turn) {
      best_turn = turn;
      best = at;
    }
  }
  return best;
}

}  // namespace

std::vector<Triangle> triangulate(std::span<const Vec3d> vertices) {
  const auto count = static_cast<std::uint32_t>(vertices.size());
  const Vec3d normal = area_vector(vertices);
  std::vector<Triangle> triangles;
  if (!(dot(normal, normal) > 0)) {
    return triangles;
  }
  if (count == 3) {
    return {{0, 1, 2}};
  }
  const Projection seen(vertices, normal);
  if (is_fan(seen, count)) {
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
      triangles.push_back({0, i, i + 1});
    }
    return triangles;
  }
  std::vector<std::uint32_t> ring(count);
  std::iota(ring.begin(), ring.end(), 0U);
  while (ring.size() > 3) {
    const std::size_t n = ring.size(), at = find_ear(seen, ring);
    triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace dmpc::core
