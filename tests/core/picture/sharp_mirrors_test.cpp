// Mirrors at sharp angles: what is shut in stays in.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "apps/lab/bench/stability/children.h"
#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/scene/frame.h"
#include "tests/support/scaled.h"

namespace sharp_mirrors_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// Four mirrors: a triangle with corners at distance 1 from local x = y = 0, and a tip above it.
Database tetrahedron(double height) {
  constexpr double half_edge = 0.8660254037844386;
  const std::array<Vec3d, 4> corner{{{0, 1, 0}, {-half_edge, -0.5, 0}, {half_edge, -0.5, 0}, {0.01, 0.02, height}}};
  Scene scene;
  SceneBuilder builder(scene);
  builder.light({.position = {0, 0, height / 4}});
  builder.material({.specular = 1, .shine = 1});
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    builder.polygon({corner[(left_out + 1) % 4], corner[(left_out + 2) % 4], corner[(left_out + 3) % 4]});
  }
  return build_database(scene, {});
}

/// On a triangle, as near to an edge as 10^-9 of its size.
Vec3d beside_edge(const PrimitiveValues& triangle, Random& random) {
  const double weight = std::pow(10.0, -random.between(3, 9)), along = random.between(weight, 1 - weight);
  const std::size_t first = random.below(3);
  const std::array<Vec3d, 3> corner{triangle.vector(0), triangle.vector(3), triangle.vector(6)};
  return corner[first] * weight + (corner[(first + 1) % 3] * along + corner[(first + 2) % 3] * (1 - along)) * (1 - weight);
}

struct Bounces {
  std::size_t count = 0, escapes = 0;
};

/// So many of each ray that starts within and is aimed beside an edge.
Bounces between_mirrors(const Database& database, std::size_t rays, int bounces_each) {
  Random random(1);
  Bounces bounces;
  const Vec3d within = to_local(database.header().frame, {0.02, 0.01, 0.1});
  for (std::size_t i = 0; i < rays; ++i) {
    Ray ray;
    ray.start_at(within);
    ray.go_along(normalize(beside_edge(database.primitives()[i % 4], random) - within));
    Hit hit = shoot(database, ray);
    for (int bounce = 0; bounce < bounces_each && hit.found(); ++bounce, ++bounces.count) {
      for (const Ray& child : children_of(database, ray, hit)) {
        ray = child;  // the last one is mirrored
      }
      ray.depth = 1;
      hit = shoot(database, ray);
    }
    bounces.escapes += hit.found() ? 0 : 1;
  }
  return bounces;
}

}  // namespace

TEST_CASE("no ray gets out of a tetrahedron of mirrors, however near to its edges they are hit") {
  for (const double height : {0.3, 1.4, 4.0, 20.0}) {
    CAPTURE(height);
    const Bounces bounces = between_mirrors(tetrahedron(height), scaled(5'000), 8);
    CHECK(bounces.count == 8 * scaled(5'000));
    CHECK(bounces.escapes == 0);
  }
}

}  // namespace sharp_mirrors_test
