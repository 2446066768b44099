#include "apps/formats/landscape/mesh.h"

#include "apps/formats/landscape/terrain.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Two triangles a square of a lattice of vertices, row by row.
void add_squares(LandscapeMesh& mesh, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t here = row * (columns + 1) + column, below = here + columns + 1;
      mesh.indices.insert(mesh.indices.end(), {here, below, here + 1, here + 1, below, below + 1});
    }
  }
}

/// With its place on the picture of the ground.
void add_ground_vertex(LandscapeMesh& mesh, const core::Vec3d& position, const core::Vec3d& normal) {
  add_vertex(mesh, position, normal);
  mesh.places.push_back({static_cast<float>((position.x + 1) / 2), static_cast<float>(position.z + 0.5)});
}

}  // namespace

void add_vertex(LandscapeMesh& mesh, const core::Vec3d& position, const core::Vec3d& normal) {
  const auto point = [](const core::Vec3d& v) {
    return LandscapeMesh::Point{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  mesh.positions.push_back(point(position));
  mesh.normals.push_back(point(normal));
}

LandscapeMesh ground_mesh(int size, const RowsDone& rows_done) {
  core::expect(size >= 1 && size <= 13, "a landscape has a size from 1 to 13");
  const std::uint32_t columns = 1U << static_cast<unsigned>(size), rows = columns / 2;
  const double step = 2.0 / columns;
  LandscapeMesh mesh;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double x = column * step - 1, z = row * step - 0.5;
      add_ground_vertex(mesh, {x, ground_height(x, z), z}, ground_normal(x, z, step));
    }
    if (rows_done) {
      rows_done(row + std::uint64_t{1}, rows + std::uint64_t{1});
    }
  }
  add_squares(mesh, columns, rows);
  return mesh;
}

LandscapeMesh lake_mesh() {
  LandscapeMesh mesh;
  for (const double z : {-0.5, 0.5}) {
    for (const double x : {-1.0, 1.0}) {
      add_ground_vertex(mesh, {x, lake_height, z}, {0, 1, 0});
    }
  }
  add_squares(mesh, 1, 1);
  return mesh;
}

}  // namespace dmpc::apps
