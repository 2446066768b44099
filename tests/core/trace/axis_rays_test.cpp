// Rays along axes and diagonals, from places where a walk is most easily confused, hit what brute force hits.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "apps/lab/bench/stability/axes.h"
#include "apps/lab/bench/stability/random.h"
#include "tests/support/referee.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace axis_rays_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

struct Differences {
  std::size_t from_brute_force = 0, from_referee = 0;
};

Database crowd_seen_from(double back) { return build_database(seen_from(crowded_scene(), back), crowded_options); }

/// Shoots along every direction from points that lie `back` extents behind an awkward one.
Differences shoot_everywhere(const Database& database, double back, std::size_t points) {
  Random random(11);
  Differences differences;
  for (std::size_t i = 0; i < points; ++i) {
    const Vec3f at = awkward_point(database, random);
    for (const Vec3f& d : axis_directions(zeros[i % zeros.size()])) {
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
  const Differences found = shoot_everywhere(build_database(crowded_scene(), crowded_options), 0, scaled(2000));
  CHECK(found.from_brute_force == 0);
  CHECK(found.from_referee == 0);
}

TEST_CASE("axis and diagonal rays from outside hit what brute force hits") {
  for (const double back : {1.0, 3.0}) {
    const Differences found = shoot_everywhere(crowd_seen_from(back), back, scaled(1000));
    CHECK(found.from_brute_force == 0);
    CHECK(found.from_referee == 0);
  }
}

TEST_CASE("axis and diagonal rays from 10 to 1,000 extents away hit what brute force hits") {
  for (const double back : {10.0, 100.0, 1000.0}) {
    CAPTURE(back);
    CHECK(shoot_everywhere(crowd_seen_from(back), back, scaled(500)).from_brute_force == 0);
  }
}

}  // namespace axis_rays_test
