#include "apps/formats/landscape/mesh.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "apps/formats/landscape/terrain.h"
#include "core/base/expect.h"

namespace dmpc::apps::mesh_test {

namespace {

/// Twice the area of a triangle as seen from above: above 0 if it is counter-clockwise.
double area_from_above(const LandscapeMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t corner, std::size_t axis) {
    return double{mesh.positions[mesh.indices[3 * triangle + corner]][axis]};
  };
  return (at(1, 2) - at(0, 2)) * (at(2, 0) - at(0, 0)) - (at(1, 0) - at(0, 0)) * (at(2, 2) - at(0, 2));
}

double area_from_above(const LandscapeMesh& mesh) {
  double sum = 0;
  for (std::size_t triangle = 0; triangle < mesh.indices.size() / 3; ++triangle) {
    const double area = area_from_above(mesh, triangle);
    CHECK(area > 0);
    sum += area / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("a ground of a size has four to its power triangles, which cover it and face upwards") {
  for (const int size : {1, 2, 5}) {
    CAPTURE(size);
    const LandscapeMesh mesh = ground_mesh(size);
    CHECK(mesh.indices.size() == 3U * (1U << static_cast<unsigned>(2 * size)));
    CHECK(mesh.normals.size() == mesh.positions.size());
    CHECK(mesh.places.size() == mesh.positions.size());
    CHECK(*std::max_element(mesh.indices.begin(), mesh.indices.end()) == mesh.positions.size() - 1);
    CHECK(area_from_above(mesh) == doctest::Approx(2));
  }
}

TEST_CASE("the texture covers the ground from corner to corner") {
  const LandscapeMesh mesh = ground_mesh(3);
  CHECK(mesh.places.front() == std::array<float, 2>{0, 0});
  CHECK(mesh.places.back() == std::array<float, 2>{1, 1});
  CHECK(mesh.positions.front()[0] == -1);
  CHECK(mesh.positions.back()[2] == 0.5F);
}

TEST_CASE("a ground without squares, or too large for its numbers, is refused") {
  CHECK_THROWS_AS(ground_mesh(0), core::InternalError);
  CHECK_THROWS_AS(ground_mesh(14), core::InternalError);
}

TEST_CASE("the lake is flat") {
  const LandscapeMesh lake = lake_mesh();
  CHECK(lake.indices.size() == 6);
  CHECK(area_from_above(lake) == doctest::Approx(2));
  for (const LandscapeMesh::Point& position : lake.positions) {
    CHECK(position[1] == static_cast<float>(lake_height));
  }
}

}  // namespace dmpc::apps::mesh_test
