// Closed meshes hold every ray that starts inside them: what R1 to R3 of `bench stability` have not, or mutants are held against.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "apps/lab/bench/stability/mesh.h"
#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "apps/lab/bench/stability/targets.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace leaks_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// What rays are aimed at: every vertex, five points of every edge, the middle of every triangle, as the records hold them.
std::vector<Vec3d> targets_of(const Database& database) {
  std::vector<Vec3d> targets;
  for (const PrimitiveValues& triangle : database.primitives()) {
    for (std::size_t i = 0; i < targets_per_triangle; ++i) {
      targets.push_back(target_of(triangle, i));
    }
  }
  return targets;
}

/// How many rays from `origins` (world) to the targets meet nothing.
std::size_t leaks(const Database& database, const std::vector<Vec3d>& origins) {
  std::size_t count = 0;
  const std::vector<Vec3d> targets = targets_of(database);
  for (const Vec3d& origin : origins) {
    for (const Vec3d& target : targets) {
      count += shoot(database, ray_through(to_local(database.header().frame, origin), target)).found() ? 0 : 1;
    }
  }
  return count;
}

/// Leaks from `count` points within `reach` of `center`, and from `center` itself.
std::size_t leaks(const Mesh& mesh, const Vec3d& center, double reach, std::size_t count) {
  Random random(7);
  std::vector<Vec3d> origins{center};
  while (origins.size() < scaled(count)) {
    origins.push_back(center + random.direction() * (reach * random.unit()));
  }
  return leaks(database_of(seen_from(scene_of(mesh), 1)), origins);
}

/// From next to the edge that two sides of a cube share, or halves of one, at a point of it.
Ray ray_at_edge(const Database& database, Random& random) {
  const PrimitiveValues& triangle = database.primitives()[random.below(database.primitives().size())];
  const std::size_t first = random.below(3);
  const Vec3d a = triangle.vector(3 * first), b = triangle.vector(3 * ((first + 1) % 3));
  const Vec3d at = a + (b - a) * random.between(0.01, 0.99), inwards = to_local(database.header().frame, {}) - at;
  Ray ray;
  ray.start_at(at + (normalize(inwards) + random.direction() * 0.3) * std::pow(2.0, -random.between(10, 24)));
  ray.go_along(normalize(at - ray.full_origin()));
  return ray;
}

constexpr Vec3d far_away{148376, 1234, -223423};

}  // namespace

TEST_CASE("a cube of twelve triangles holds every ray") { CHECK(leaks(cube(), {}, 0.95, 2000) == 0); }

TEST_CASE("a cube holds rays that start next to its edges") {
  const Database database = database_of(seen_from(scene_of(cube()), 1));
  Random random(8);
  std::size_t leaked = 0, differences = 0;
  for (std::size_t i = 0; i < scaled(100'000); ++i) {
    const Ray ray = ray_at_edge(database, random);
    const Hit hit = shoot(database, ray);
    leaked += hit.found() ? 0 : 1;
    differences += same_hit(brute_force(database, ray), hit) ? 0 : 1;
  }
  CHECK(leaked == 0);
  CHECK(differences == 0);
}

TEST_CASE("a sphere of triangles holds every ray") { CHECK(leaks(sphere_mesh(16, 32, 0), {}, 0.9, 100) == 0); }

TEST_CASE("a closed mesh far from the world's origin holds every ray") {
  CHECK(leaks(rounded(moved(sphere_mesh(16, 32, 0), 1, far_away)), far_away, 0.8, 50) == 0);
  CHECK(leaks(rounded(moved(cube(), 1, far_away)), far_away, 0.8, 500) == 0);
  CHECK(leaks(rounded(moved(sphere_mesh(16, 32, 0.4), 1, {1e6, -1e6, 1e6})), {1e6, -1e6, 1e6}, 0.3, 50) == 0);
}

TEST_CASE("rays along the axes with zeros of both signs leave no closed mesh") {
  const Database database = database_of(scene_of(sphere_mesh(16, 32, 0.1)));
  Random random(5);
  std::size_t leaked = 0;
  for (std::size_t i = 0; i < scaled(20000); ++i) {
    const Vec3f origin(to_local(database.header().frame, random.in_box(-0.4, 0.4)));
    for (const float zero : {0.0F, -0.0F}) {
      for (const float one : {1.0F, -1.0F}) {
        for (const Vec3f& d : {Vec3f{one, zero, zero}, Vec3f{zero, one, zero}, Vec3f{zero, zero, one}}) {
          leaked += shoot(database, ray_from(origin, d)).found() ? 0 : 1;
        }
      }
    }
  }
  CHECK(leaked == 0);
}

}  // namespace leaks_test
