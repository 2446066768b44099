#include "apps/foreign/mesh/round_mesh.h"

#include <algorithm>
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

int rows_of(RoundKind kind) { return kind == RoundKind::sphere ? faces_around / 2 : 1; }

SurfacePoint on_sphere(const RoundShape& shape, double around, double v) {
  const auto latitude_at = [r = shape.radius](double z) { return core::angle_of(z, std::sqrt(std::max(r * r - z * z, 0.0))); };
  const double low = latitude_at(shape.least_z), high = latitude_at(shape.most_z);
  const double latitude = low + (high - low) * v, across = core::cos_radians(latitude);
  const Vec3d out{across * core::cos_degrees(around), across * core::sin_degrees(around), core::sin_radians(latitude)};
  return {out * shape.radius, out};
}

SurfacePoint on_cylinder(const RoundShape& shape, double around, double v) {
  const Vec3d out{core::cos_degrees(around), core::sin_degrees(around), 0};
  return {out * shape.radius + Vec3d{0, 0, shape.least_z + (shape.most_z - shape.least_z) * v}, out};
}

SurfacePoint on_ring(const RoundShape& shape, double around, double v) {
  const double out = shape.radius + (shape.inner - shape.radius) * v;
  return {{out * core::cos_degrees(around), out * core::sin_degrees(around), shape.least_z}, {0, 0, 1}};
}

}  // namespace

PolygonMesh mesh_of(const RoundShape& shape) {
  const auto at = shape.kind == RoundKind::sphere ? on_sphere : shape.kind == RoundKind::cylinder ? on_cylinder : on_ring;
  return grid_mesh(columns_of(shape.degrees), rows_of(shape.kind),
                   [&](double u, double v) { return at(shape, shape.degrees * u, v); });
}

GeometrySize size_of_copy(const RoundShape& shape) {
  const auto faces = static_cast<std::uint64_t>(columns_of(shape.degrees) * rows_of(shape.kind));
  return size_of_faces(faces, 4 * faces, sizeof(Vec3d));
}

}  // namespace dmpc::apps
