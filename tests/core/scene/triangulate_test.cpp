#include "core/scene/triangulate.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "apps/bench/stability/random.h"
#include "core/families/scenes.h"

using namespace dmpc::apps;
using namespace dmpc::core;
using dmpc::apps::Random;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Vec3d area(const std::vector<Vec3d>& vertices) {
  Vec3d sum;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    sum = sum + cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]) * 0.5;
  }
  return sum;
}

/// Their areas add up to the polygon's, all turn its way and have an area.
void check_areas(const std::vector<Vec3d>& vertices, const Triangles& triangles) {
  const Vec3d whole = area(vertices), normal = normalize(whole);
  double sum = 0;
  for (const auto& t : triangles) {
    const double part = dot(area({vertices[t[0]], vertices[t[1]], vertices[t[2]]}), normal);
    CHECK(part > 0);
    sum += part;
  }
  CHECK(triangles.size() == vertices.size() - 2);
  CHECK(sum == doctest::Approx(length(whole)).epsilon(1e-9));
}

/// Every edge of the polygon belongs to one triangle, in its direction; every other edge to two, in both.
void check_closed(std::uint32_t count, const Triangles& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    ++edges[{(i + 1) % count, i}];  // the neighbour's
  }
  for (const auto& [edge, uses] : edges) {
    CHECK(uses == 1);
    CHECK(edges.count({edge.second, edge.first}) == 1);
  }
}

void check(const std::vector<Vec3d>& vertices) {
  const Triangles triangles = triangulate(vertices);
  check_areas(vertices, triangles);
  check_closed(static_cast<std::uint32_t>(vertices.size()), triangles);
}

/// A polygon about the z axis whose radii alternate.
std::vector<Vec3d> star(std::uint32_t points, double inner) {
  std::vector<Vec3d> vertices;
  for (std::uint32_t i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? 1.0 : inner;
    vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return vertices;
}

}  // namespace

TEST_CASE("a triangle stays what it is") {
  const std::vector<Vec3d> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK(triangulate(triangle) == Triangles{{0, 1, 2}});
}

TEST_CASE("convex polygons become a fan") {
  for (std::uint32_t corners = 4; corners <= 40; corners += 6) {
    check(star(corners / 2, 1.0));
  }
}

TEST_CASE("concave polygons keep their area and their edges") {
  check({{0, 0, 0}, {2, 0, 0}, {0.2, 0.2, 0}, {0, 2, 0}});
  check({{0, 0, 1}, {0, 2, 0}, {0, 1, 1}, {0, 2, 2}});
  check(star(5, 0.3));
  check(star(40, 0.9));
}

TEST_CASE("polygons in any plane and of either winding keep their area") {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3d right = normalize(random.direction()), other = normalize(cross(right, random.direction()));
    std::vector<Vec3d> vertices;
    for (const Vec3d& v : star(3 + random.below(8), random.between(0.2, 1.2))) {
      vertices.push_back(right * v.x + other * v.y);
    }
    check(vertices);
  }
}

TEST_CASE("the gears' faces keep their area and their edges") {
  const Scene scene = built_in_scene({.family = "gears", .size = 1, .tessellation = 0});
  std::uint32_t largest = 0;
  for (const Object& object : scene.objects) {
    const auto first = scene.vertices.begin() + object.first;
    check(std::vector<Vec3d>(first, first + object.vertex_count));
    largest = std::max(largest, object.vertex_count);
  }
  CHECK(largest == 144);
}

TEST_CASE("corners on a straight edge make no triangle without area") {
  check({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}});
  check({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  check({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 0}});
}

TEST_CASE("polygons without area give nothing") {
  CHECK(triangulate(std::vector<Vec3d>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}).empty());
  CHECK(triangulate(std::vector<Vec3d>{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}).empty());
  CHECK(triangulate(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}).empty());
}

TEST_CASE("polygons that cross themselves come to an end") {
  const auto triangles = triangulate(std::vector<Vec3d>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 3, 0}, {1, 1, 0}});
  CHECK(triangles.size() <= 3);
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    std::vector<Vec3d> vertices(20);
    for (Vec3d& v : vertices) {
      v = random.in_box(-1, 1);
    }
    CHECK(triangulate(vertices).size() <= 18);
  }
}
