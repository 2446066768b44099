#include "apps/foreign/mesh/round_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/base/elementary.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

struct SurfacePoint {
  Vec3d point, normal;
};

/// A grid over u and v, both from 0 to 1; faces look to where u, then v turn counter-clockwise.
PolygonMesh grid_mesh(int columns, int rows, const std::function<SurfacePoint(double u, double v)>& at) {
  PolygonMesh mesh{.name = {}, .is_by_vertex = true};
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const SurfacePoint surface = at(static_cast<double>(column) / columns, static_cast<double>(row) / rows);
      mesh.vertices.push_back(surface.point);
      mesh.normals.push_back(surface.normal);
      mesh.places.push_back(
          {static_cast<float>(column) / static_cast<float>(columns), 1 - static_cast<float>(row) / static_cast<float>(rows)});
    }
  }
  const auto vertex = [&](int column, int row) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      mesh.faces.corners.insert(mesh.faces.corners.end(), {vertex(column, row), vertex(column + 1, row),
                                                           vertex(column + 1, row + 1), vertex(column, row + 1)});
      mesh.faces.ends.push_back(static_cast<std::uint32_t>(mesh.faces.corners.size()));
    }
  }
  return mesh;
}

int columns_of(double degrees) {
  return std::clamp(static_cast<int>(std::lround(faces_around * degrees / 360)), 3, faces_around);
}

}  // namespace

PolygonMesh sphere_mesh(const SpherePart& part) {
  const double low =
      core::angle_of(part.least_z, std::sqrt(std::max(part.radius * part.radius - part.least_z * part.least_z, 0.0)));
  const double high =
      core::angle_of(part.most_z, std::sqrt(std::max(part.radius * part.radius - part.most_z * part.most_z, 0.0)));
  return grid_mesh(columns_of(part.degrees), faces_around / 2, [&](double u, double v) {
    const double latitude = low + (high - low) * v, around = part.degrees * u, across = core::cos_radians(latitude);
    const Vec3d out{across * core::cos_degrees(around), across * core::sin_degrees(around), core::sin_radians(latitude)};
    return SurfacePoint{out * part.radius, out};
  });
}

PolygonMesh cylinder_mesh(const SpherePart& part) {
  return grid_mesh(columns_of(part.degrees), 1, [&](double u, double v) {
    const double around = part.degrees * u;
    const Vec3d out{core::cos_degrees(around), core::sin_degrees(around), 0};
    return SurfacePoint{out * part.radius + Vec3d{0, 0, part.least_z + (part.most_z - part.least_z) * v}, out};
  });
}

PolygonMesh ring_mesh(double height, double radius, double inner, double degrees) {
  return grid_mesh(columns_of(degrees), 1, [&](double u, double v) {
    const double around = degrees * u, out = radius + (inner - radius) * v;
    return SurfacePoint{{out * core::cos_degrees(around), out * core::sin_degrees(around), height}, {0, 0, 1}};
  });
}

}  // namespace dmpc::apps
