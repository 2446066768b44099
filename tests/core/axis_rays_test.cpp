// Rays along axes and diagonals, from places where a walk is most easily confused, hit what brute force hits.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "tests/support/mesh.h"
#include "tests/support/random.h"
#include "tests/support/referee.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

using namespace dmpc::core;
using namespace dmpc::tests;

namespace {

/// What stands for 0 in a direction: both zeros, a denormal number, a number whose reciprocal overflows with the grid's extent.
constexpr std::array<float, 8> zeros{0.0F, -0.0F, 1e-40F, -1e-40F, 1e-30F, -1e-30F, 9e-19F, -9e-19F};

/// The 26 directions with components -1, 0 and 1, not of unit length.
std::vector<Vec3f> directions(float zero) {
  std::vector<Vec3f> all;
  const std::array<float, 3> values{-1.0F, zero, 1.0F};
  for (std::size_t i = 0; i < 27; ++i) {
    if (i != 13) {
      all.push_back({values[i % 3], values[i / 3 % 3], values[i / 9]});
    }
  }
  return all;
}

Vec3f normalised(const Vec3f& d) {
  const double size = length(Vec3d(d));
  const auto scaled_down = [&](float x) { return std::fabs(x) < 1.0F ? x : static_cast<float>(double{x} / size); };
  return {scaled_down(d.x), scaled_down(d.y), scaled_down(d.z)};
}

/// Boxes with faces along the axes, two meshes without, and sheets that cut through everything.
Scene crowded_scene() {
  Scene scene;
  add(scene, moved(sphere_mesh(8, 12, 0.2), 0.5, {0.3, 0.3, 0}));
  add(scene, cube());
  add(scene, moved(cube(), 0.25, {-0.5, -0.5, 0.5}));
  add(scene, moved(tetrahedron(), 0.25, {0.5, -0.5, -0.5}));
  SceneBuilder builder(scene);
  for (const double z : {-0.5, 0.0, 0.25}) {
    builder.polygon({{-0.9, -0.9, z}, {0.9, -0.9, z}, {0.9, 0.9, z}, {-0.9, 0.9, z}});
  }
  return scene;
}

/// A coordinate on a cell's plane (of a random level), on the scene's bound, or anywhere.
double awkward(const Database& database, std::size_t axis, Random& random) {
  const GridFrame& frame = database.header().frame;
  const int cells = frame.resolution[axis] * finest_per_top;
  switch (random.below(4)) {
    case 0:
      return double{frame.finest_cell} * (random.below(static_cast<std::size_t>(cells)) &
                                          -static_cast<std::uint32_t>(span_of(static_cast<int>(random.below(4)))));
    case 1:
      return to_local(frame, random.bits() % 2 == 0 ? Vec3d{-1, -1, -1} : Vec3d{1, 1, 1})[axis];
    case 2:
      return to_local(frame, Vec3d{0.25, 0.25, 0.25})[axis];
    default:
      return random.between(0, double{frame.finest_cell} * cells);
  }
}

Vec3f awkward_point(const Database& database, Random& random) {
  const double x = awkward(database, 0, random), y = awkward(database, 1, random);
  return Vec3f(Vec3d{x, y, awkward(database, 2, random)});
}

struct Differences {
  std::size_t from_brute_force = 0, from_referee = 0;
};

/// Shoots along every direction from points that lie `back` extents behind an awkward one.
Differences shoot_everywhere(const Database& database, double back, std::size_t points) {
  Random random(11);
  Differences differences;
  for (std::size_t i = 0; i < points; ++i) {
    const Vec3f at = awkward_point(database, random);
    for (const Vec3f& raw : directions(zeros[i % zeros.size()])) {
      const Vec3f d = normalised(raw);
      const Ray ray = ray_from(at - d * static_cast<float>(back), d);
      const Hit hit = shoot(database, ray);
      differences.from_brute_force += same_hit(hit, brute_force(database, ray)) ? 0 : 1;
      differences.from_referee += judge(database, ray, 2e-6).allows(hit, 1e-6 * (1 + back)) ? 0 : 1;
    }
  }
  return differences;
}

}  // namespace

TEST_CASE("axis and diagonal rays from planes, edges and corners of cells hit what brute force hits") {
  const Differences found = shoot_everywhere(database_of(crowded_scene()), 0, scaled(2000));
  CHECK(found.from_brute_force == 0);
  CHECK(found.from_referee == 0);
}

TEST_CASE("axis and diagonal rays from outside hit what brute force hits") {
  for (const double back : {1.0, 3.0}) {
    const Differences found = shoot_everywhere(database_of(seen_from(crowded_scene(), back)), back, scaled(1000));
    CHECK(found.from_brute_force == 0);
    CHECK(found.from_referee == 0);
  }
}

TEST_CASE("axis and diagonal rays from 10 to 1,000 extents away hit what brute force hits") {
  for (const double back : {10.0, 100.0, 1000.0}) {
    CAPTURE(back);
    const Database database = database_of(seen_from(crowded_scene(), back));
    CHECK(shoot_everywhere(database, back, scaled(500)).from_brute_force == 0);
  }
}
