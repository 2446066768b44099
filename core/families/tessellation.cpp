#include "core/families/tessellation.h"

#include <array>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::core::scenes {

/// A cube's face projected to the sphere: (N + 1)^2 unit vectors.
struct TessellatingSink::Face {
  std::size_t side = 0;
  std::vector<Vec3d> points;

  const Vec3d& at(std::size_t u, std::size_t v) const { return points[u * side + v]; }
};

namespace {

std::vector<Vec3d> top_face(int tessellation) {
  std::vector<Vec3d> points;
  for (int u = 0; u <= tessellation; ++u) {
    const Turn a = turn_degrees(45 * (2.0 * u / tessellation - 1));
    for (int v = 0; v <= tessellation; ++v) {
      const Turn b = turn_degrees(45 * (2.0 * v / tessellation - 1));
      points.push_back(normalize(Vec3d{a.sine * b.cosine, -a.cosine * b.sine, a.cosine * b.cosine}));
    }
  }
  return points;
}

/// A quarter turn (p, q) -> (-q, p) in the plane of two axes.
void turn_quarter(std::vector<Vec3d>& points, std::size_t p, std::size_t q) {
  for (Vec3d& point : points) {
    const double former = point[p];
    point[p] = -point[q];
    point[q] = former;
  }
}

/// A unit vector perpendicular to the axis.
Vec3d first_radial(const Vec3d& axis) {
  const Vec3d across = cross(axis, {0, 0, 1});
  return normalize(length(across) < 1e-7 ? cross(axis, {1, 0, 0}) : across);
}

}  // namespace

TessellatingSink::TessellatingSink(int tessellation, SceneSink& target) : target_(target) {
  expect(tessellation >= 1, "a curve is divided at least once");
  Face face{static_cast<std::size_t>(tessellation) + 1, top_face(tessellation)};
  constexpr std::array<std::pair<std::size_t, std::size_t>, 3> planes = {{{0, 2}, {0, 1}, {1, 2}}};
  for (std::size_t i = 0; i < 6; ++i) {
    turn_quarter(face.points, planes[i % 3].first, planes[i % 3].second);
    add_face(face);
  }
  for (int k = 0; k <= 4 * tessellation; ++k) {
    turns_.push_back(turn_degrees(360.0 * k / (4 * tessellation)));
  }
}

void TessellatingSink::add_face(const Face& face) {
  for (std::size_t u = 0; u + 1 < face.side; ++u) {
    for (std::size_t v = 0; v + 1 < face.side; ++v) {
      const Vec3d &here = face.at(u, v), &across = face.at(u + 1, v + 1);
      directions_.insert(directions_.end(), {here, face.at(u, v + 1), across, across, face.at(u + 1, v), here});
    }
  }
}

void TessellatingSink::sphere(const Vec3d& center, double radius) {
  for (std::size_t i = 0; i < directions_.size(); i += 3) {
    add_sphere_triangle(center, radius, &directions_[i]);
  }
}

void TessellatingSink::add_sphere_triangle(const Vec3d& center, double radius, const Vec3d* corner) {
  target_.patch({center + radius * corner[0], center + radius * corner[1], center + radius * corner[2]},
                {corner[0], corner[1], corner[2]});
}

void TessellatingSink::cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius) {
  const Vec3d axis = apex - base;
  const double height = length(axis);
  const Vec3d unit = axis * (1 / height), radial = first_radial(axis);
  const auto normal_of = [&](const Vec3d& side) {
    return base_radius == apex_radius ? side : normalize(height * side + (base_radius - apex_radius) * unit);
  };
  Vec3d old_side = radial;
  for (std::size_t k = 1; k < turns_.size(); ++k) {
    const Vec3d side = rotated(radial, unit, turns_[k]);
    const Vec3d normal = normal_of(side), old_normal = normal_of(old_side);
    const Vec3d apex_new = apex + apex_radius * side, base_old = base + base_radius * old_side;
    target_.patch({apex_new, apex + apex_radius * old_side, base_old}, {normal, old_normal, old_normal});
    target_.patch({base + base_radius * side, apex_new, base_old}, {normal, normal, old_normal});
    old_side = side;
  }
}

}  // namespace dmpc::core::scenes
