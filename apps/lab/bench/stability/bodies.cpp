#include "apps/lab/bench/stability/bodies.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "apps/lab/bench/stability/mesh.h"

namespace dmpc::apps {
namespace {

using core::Scene;
using core::Vec3d;

const core::View view_of_body{.from = {5, 0, 0}, .at = {0, 0, 0}, .up = {0, 0, 1}};

std::function<Vec3d(Random&)> in_ball(double radius) {
  return [radius](Random& random) { return random.direction() * (radius * random.unit()); };
}

ClosedBody mesh_body(std::string name, const Mesh& mesh, std::function<Vec3d(Random&)> inside) {
  Scene scene = scene_of(mesh);
  scene.view = view_of_body;
  return {std::move(name), std::move(scene), std::move(inside)};
}

Vec3d within_tube(Random& random) {
  const double angle = 2 * std::numbers::pi * random.unit();
  return Vec3d{std::cos(angle), std::sin(angle), 0} + random.direction() * (0.15 * random.unit());
}

/// A prism over a five-pointed star: every second corner of both its lids is a notch.
Scene star_prism() {
  constexpr std::size_t corners = 10;
  std::array<Vec3d, corners> lower, upper;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / corners, radius = i % 2 == 0 ? 1.0 : 0.45;
    lower[i] = {radius * std::cos(angle), radius * std::sin(angle), -0.5};
    upper[i] = {lower[i].x, lower[i].y, 0.5};
  }
  Scene scene;
  scene.view = view_of_body;
  core::SceneBuilder builder(scene);
  builder.polygon({upper.begin(), upper.end()});
  builder.polygon({lower.rbegin(), lower.rend()});
  for (std::size_t i = 0; i < corners; ++i) {
    const std::size_t next = (i + 1) % corners;
    builder.polygon({lower[i], lower[next], upper[next], upper[i]});
  }
  return scene;
}

/// A cylinder and a cone whose open ends lie within spheres.
Scene limbs() {
  Scene scene;
  scene.view = view_of_body;
  core::SceneBuilder builder(scene);
  builder.cone({-0.8, 0, 0}, 0.3, {0, 0, 0}, 0.3);
  builder.cone({0, 0, 0}, 0.3, {0.1, 0.2, 0.8}, 0.1);
  builder.sphere({-0.8, 0, 0}, 0.35);
  builder.sphere({0, 0, 0}, 0.35);
  builder.sphere({0.1, 0.2, 0.8}, 0.15);
  return scene;
}

Vec3d within_limb(Random& random) { return Vec3d{random.between(-0.8, 0), 0, 0} + random.direction() * (0.2 * random.unit()); }

}  // namespace

std::vector<ClosedBody> closed_bodies() {
  const auto in_cube = [](Random& random) { return random.in_box(-0.95, 0.95); };
  return {mesh_body("cube", cube(), in_cube),
          mesh_body("tetrahedron", tetrahedron(), in_ball(0.5)),
          mesh_body("sphere", sphere_mesh(16, 32, 0), in_ball(0.9)),
          mesh_body("noisy sphere", sphere_mesh(16, 32, 0.4), in_ball(0.4)),
          mesh_body("torus", torus(24, 12, 0.3), within_tube),
          {"prism over a concave polygon", star_prism(), in_ball(0.3)},
          {"spheres, cones and cylinders", limbs(), within_limb, false}};
}

ClosedBody fine_sphere() { return mesh_body("fine sphere", sphere_mesh(70, 70, 0.1), in_ball(0.8)); }

Scene transformed(Scene scene, double factor, const Vec3d& offset, bool in_single) {
  const auto put = [&](Vec3d& point) {
    point = point * factor + offset;
    if (in_single) {
      point = Vec3d(core::Vec3f(point));
    }
  };
  for (Vec3d& vertex : scene.vertices) {
    put(vertex);
  }
  for (core::Sphere& sphere : scene.spheres) {
    put(sphere.center);
    sphere.radius *= factor;
  }
  for (core::Cone& cone : scene.cones) {
    put(cone.base);
    put(cone.apex);
    cone.base_radius *= factor;
    cone.apex_radius *= factor;
  }
  for (core::PointLight& light : scene.lights) {
    put(light.position);
  }
  scene.view.from = scene.view.from * factor + offset;
  scene.view.at = scene.view.at * factor + offset;
  return scene;
}

bool is_closed(std::span<const core::PrimitiveValues> triangles) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> surplus;  // edges from the lower to the higher point
  for (const core::PrimitiveValues& triangle : triangles) {
    const auto& v = triangle.value;
    const std::array<Point, 3> corner{Point{v[0], v[1], v[2]}, Point{v[3], v[4], v[5]}, Point{v[6], v[7], v[8]}};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &from = corner[k], &to = corner[(k + 1) % 3];
      surplus[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  for (const auto& [edge, count] : surplus) {
    if (count != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace dmpc::apps
