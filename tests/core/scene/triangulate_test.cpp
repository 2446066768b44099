#include "core/scene/triangulate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include "apps/lab/bench/stability/random.h"
#include "core/families/scenes.h"
#include "core/scene/ear_clipper.h"
#include "core/scene/flat_polygon.h"

namespace triangulate_test {

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

/// A polygon about the z axis with a radius of its own at every corner.
std::vector<Vec3d> ragged(std::uint32_t corners, Random& random) {
  std::vector<Vec3d> vertices;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, radius = random.between(0.1, 1);
    vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return vertices;
}

/// Ears by looking through all corners: what clip_ears() is to be quicker than.
class SlowClipper {
 public:
  explicit SlowClipper(const FlatPolygon& polygon) : polygon_(polygon), ring_(polygon.count()) {
    std::iota(ring_.begin(), ring_.end(), 0U);
  }

  Triangles triangles() {
    Triangles result;
    while (ring_.size() > 3) {
      const std::size_t at = find_ear();
      result.push_back(triangle_at(at));
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(at));
    }
    result.push_back({ring_[0], ring_[1], ring_[2]});
    return result;
  }

 private:
  CornerTriangle triangle_at(std::size_t at) const {
    return {ring_[(at + ring_.size() - 1) % ring_.size()], ring_[at], ring_[(at + 1) % ring_.size()]};
  }
  double turn_at(std::size_t at) const {
    const auto [before, corner, after] = triangle_at(at);
    return polygon_.turn(before, corner, after);
  }
  std::size_t find_ear() const {
    std::size_t best = 0;
    double best_turn = -1;
    for (std::size_t at = 0; at < ring_.size(); ++at) {
      const double turn = turn_at(at);
      if (turn > 0 &&
          std::none_of(ring_.begin(), ring_.end(), [&](std::uint32_t p) { return polygon_.hinders(p, triangle_at(at)); })) {
        return at;
      }
      if (turn > best_turn) {
        best_turn = turn;
        best = at;
      }
    }
    return best;
  }

  const FlatPolygon& polygon_;
  std::vector<std::uint32_t> ring_;
};

/// Requires a polygon that is no fan.
Triangles by_definition(const std::vector<Vec3d>& vertices) {
  const Vec3d normal = area(vertices);
  return dot(normal, normal) > 0 ? SlowClipper(FlatPolygon(vertices, normal)).triangles() : Triangles{};
}

std::vector<Vec3d> ragged_of(std::uint32_t corners) {
  Random random(4);
  return ragged(corners, random);
}
std::vector<Vec3d> star_of(std::uint32_t corners) { return star(corners / 2, 0.5); }
/// Teeth on a bar.
std::vector<Vec3d> comb_of(std::uint32_t corners) {
  std::vector<Vec3d> vertices{{static_cast<double>(corners), -1, 0}};
  for (std::uint32_t i = corners - 2; i > 0; --i) {
    vertices.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 100.0, 0});
  }
  vertices.push_back({0, -1, 0});
  return vertices;
}
/// A band wound round the middle.
std::vector<Vec3d> spiral_of(std::uint32_t corners) {
  std::vector<Vec3d> vertices;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const bool is_outer = i < corners / 2;
    const double step = is_outer ? i : corners - 1 - i, angle = step * 0.05;
    const double radius = 1 + angle / (2 * std::numbers::pi) + (is_outer ? 0.4 : 0);
    vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return vertices;
}
/// A square with most corners on its edges.
std::vector<Vec3d> straight_of(std::uint32_t corners) {
  std::vector<Vec3d> vertices;
  const std::uint32_t side = corners / 4;
  for (std::uint32_t i = 0; i < 4 * side; ++i) {
    const double along = static_cast<double>(i % side) / side;
    const Vec3d places[] = {{along, 0, 0}, {1, along, 0}, {1 - along, 1, 0}, {0, 1 - along, 0}};
    vertices.push_back(places[i / side]);
  }
  return vertices;
}
/// Every third corner in one place.
std::vector<Vec3d> flower_of(std::uint32_t corners) {
  std::vector<Vec3d> vertices(corners);
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    vertices[i] = i % 3 == 0 ? Vec3d{} : Vec3d{std::cos(angle), std::sin(angle), 0};
  }
  return vertices;
}
std::vector<Vec3d> tangle_of(std::uint32_t corners) {
  Random random(5);
  std::vector<Vec3d> vertices(corners);
  for (Vec3d& v : vertices) {
    v = {random.between(-1, 1), random.between(-1, 1), 0};
  }
  return vertices;
}

struct Shape {
  const char* name;
  std::vector<Vec3d> (*of)(std::uint32_t corners);
  bool is_simple;
};
constexpr Shape all_shapes[] = {{"ragged", ragged_of, true}, {"star", star_of, true},         {"comb", comb_of, true},
                                {"spiral", spiral_of, true}, {"straight", straight_of, true}, {"flower", flower_of, false},
                                {"tangle", tangle_of, false}};

/// They cover the polygon once.
void check_area_of_all(const std::vector<Vec3d>& vertices, const Triangles& triangles) {
  double sum = 0, least = 1;
  for (const auto& t : triangles) {
    const double part = area({vertices[t[0]], vertices[t[1]], vertices[t[2]]}).z;
    sum += part;
    least = std::min(least, part);
  }
  CHECK(least >= 0);
  CHECK(sum == doctest::Approx(area(vertices).z).epsilon(1e-9));
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

TEST_CASE("the first ear is cut off again and again, as by looking through all corners each time") {
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    const std::vector<Vec3d> simple = ragged(100 + random.below(200), random);
    CHECK(triangulate(simple) == by_definition(simple));
    std::vector<Vec3d> tangled(16 + random.below(150));
    for (Vec3d& v : tangled) {
      v = {std::floor(random.between(0, 12)), std::floor(random.between(0, 12)), 0};  // many in one place, many on a line
    }
    CHECK(triangulate(tangled) == by_definition(tangled));
  }
}

TEST_CASE("polygons of thousands of corners are no more work than their corners, whatever their shape") {
  for (const Shape& shape : all_shapes) {
    CAPTURE(std::string(shape.name));
    const std::uint32_t corners = 20'000;
    const std::vector<Vec3d> vertices = shape.of(corners);
    const FlatPolygon seen(vertices, area(vertices));
    const auto [triangles, nodes_visited] = clip_ears(seen);
    // Looking through all corners each time, or again for each time that a corner was hindered, takes ten times as many or more.
    CHECK(static_cast<double>(nodes_visited) < 16 * corners * std::log2(corners));
    CHECK(triangles == triangulate(vertices));
    CHECK(triangles.size() == vertices.size() - 2);
    if (shape.is_simple) {
      check_area_of_all(vertices, triangles);
    }
  }
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

}  // namespace triangulate_test
