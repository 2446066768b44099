#include "apps/formats/landscape/grove.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>

#include "apps/formats/landscape/terrain.h"
#include "core/base/vec.h"
#include "core/scene/base_meshes.h"

namespace dmpc::apps::grove_test {

namespace {

using core::Vec3d;

Vec3d vec(const LandscapeMesh::Point& point) { return {double{point[0]}, double{point[1]}, double{point[2]}}; }

std::size_t tree_count(const Grove& trees) {
  std::size_t count = 0;
  for (const TreePlaces& places : trees.places) {
    count += places.translations.size();
    CHECK(places.rotations.size() == places.translations.size());
    CHECK(places.scales.size() == places.translations.size());
  }
  return count;
}

}  // namespace

TEST_CASE("a tree is 1 high, of as many triangles as are said, each with an area and normals of unit length") {
  for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
    CAPTURE(kind);
    const Tree tree = apps::tree(kind);
    CHECK(tree.bark.indices.size() == 3 * std::size_t{bark_triangles});
    CHECK(tree.leaves.indices.size() == 3 * std::size_t{leaf_triangles});
    double top = 0;
    for (const LandscapeMesh* mesh : {&tree.bark, &tree.leaves}) {
      REQUIRE(mesh->normals.size() == mesh->positions.size());
      for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
        const Vec3d a = vec(mesh->positions[mesh->indices[i]]), b = vec(mesh->positions[mesh->indices[i + 1]]),
                    c = vec(mesh->positions[mesh->indices[i + 2]]);
        CHECK(length(cross(b - a, c - a)) > 1e-5);
        CHECK(std::min({a.y, b.y, c.y}) >= 0);
        CHECK(length(vec(mesh->normals[mesh->indices[i]])) == doctest::Approx(1));
        top = std::max({top, a.y, b.y, c.y});
      }
    }
    CHECK(top == doctest::Approx(1).epsilon(0.1));
  }
}

TEST_CASE("bark looks outwards, as its normals say") {
  for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
    CAPTURE(kind);
    const LandscapeMesh bark = apps::tree(kind).bark;
    for (std::size_t i = 0; i < bark.indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return vec(bark.positions[bark.indices[i + k]]); };
      const auto normal = [&](std::size_t k) { return vec(bark.normals[bark.indices[i + k]]); };
      CHECK(dot(cross(corner(1) - corner(0), corner(2) - corner(0)), normal(0) + normal(1) + normal(2)) > 0);
    }
  }
}

TEST_CASE("bark and leaves are each enough to be kept as a mesh that stands in several places") {
  CHECK(bark_triangles > core::copied_triangles_max);
  CHECK(leaf_triangles > core::copied_triangles_max);
  CHECK(bark_triangles + leaf_triangles == 2048);
}

TEST_CASE("trees stand on the ground, above the lake and below the tree line, upright and turned about") {
  const Grove trees = grove(4);
  for (const TreePlaces& places : trees.places) {
    REQUIRE_FALSE(places.translations.empty());
    for (std::size_t i = 0; i < places.translations.size(); ++i) {
      const auto [x, y, z] = places.translations[i];
      CHECK(double{y} == doctest::Approx(ground_height(double{x}, double{z})).epsilon(1e-4));
      CHECK(y > lake_height);
      const auto [sine_x, sine_y, sine_z, cosine] = places.rotations[i];
      CHECK(sine_x == 0);
      CHECK(sine_z == 0);
      CHECK(sine_y * sine_y + cosine * cosine == doctest::Approx(1));
      CHECK(places.scales[i][0] > 0.01F);
      CHECK(places.scales[i][0] == places.scales[i][2]);
    }
  }
}

TEST_CASE("a grove has up to two trees for each of 4^size, and a larger one more") {
  const std::size_t three = tree_count(grove(3)), four = tree_count(grove(4));
  CHECK(three <= 128);
  CHECK(four <= 512);
  CHECK(four > 3 * three);
}

}  // namespace dmpc::apps::grove_test
