// Every point of every primitive lies in boxes that lead to the primitive: what R6 of `bench stability` has not.
#include <doctest/doctest.h>

#include "apps/lab/bench/stability/listing.h"
#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/targets.h"
#include "tests/support/border_scene.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace insertion_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// How many of `count` points a primitive lie in no box that leads to it. A point less than `slack` from another macro cell may
/// be listed there instead.
std::size_t unlisted(const Database& database, std::size_t count, double slack) {
  const Listing listing(database);
  Random random(17);
  std::size_t missing = 0;
  for (std::uint32_t id = 0; id < database.primitives().size(); ++id) {
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d at = surface_point(database.primitives()[id], random);
      bool listed = listing.lists(at, id);
      for (std::size_t corner = 0; corner < 8 && !listed && slack > 0; ++corner) {
        const auto towards = [&](std::size_t axis) { return (corner >> axis & 1U) != 0 ? slack : -slack; };
        listed = listing.lists(at + Vec3d{towards(0), towards(1), towards(2)}, id);
      }
      missing += listed ? 0 : 1;
    }
  }
  return missing;
}

/// With the pad as it is: strictly. Without a pad: to the rounding of the sample points.
void check_listed(const Scene& scene, std::size_t count) {
  BuildOptions options{.cells_per_primitive = 4};  // several macro cells
  CHECK(unlisted(build_database(scene, options), count, 0) == 0);
  options.pad_share = 0;
  CHECK(unlisted(build_database(scene, options), count, 1e-12) == 0);
}

}  // namespace

TEST_CASE("triangles exactly in planes between cells are listed on a side of them even without a pad") {
  BuildOptions options = BorderScene::options();
  options.pad_share = 0;
  CHECK(unlisted(build_database(BorderScene().scene(), options), scaled(1000), 1e-12) == 0);
}

TEST_CASE("spheres of all sizes are listed wherever their surface is") {
  Random random(5);
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 300; ++i) {
    builder.sphere(random.in_box(-1, 1), std::pow(10.0, random.between(-4, 0)) * (i % 5 == 0 ? -1 : 1));
  }
  check_listed(scene, scaled(1000));
}

TEST_CASE("cones and cylinders are listed wherever their surface is") {
  Random random(6);
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 300; ++i) {
    const Vec3d base = random.in_box(-1, 1), axis = i % 3 == 0 ? Vec3d{0, 0, 0.3} : random.in_box(-0.5, 0.5);
    const double radius = std::pow(10.0, random.between(-4, -0.5));
    builder.cone(base, radius, base + axis, i % 2 == 0 ? radius : random.unit() * 0.2);
  }
  check_listed(scene, scaled(1000));
}

TEST_CASE("nearly upright cylinders reach as far as they should") {
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < 60; ++i) {
    builder.cone({i / 60.0, 0, 0}, 0.5, {i / 60.0 + std::ldexp(1.0, -i), std::ldexp(1.0, -i / 2), 1}, 0.5);
  }
  check_listed(scene, scaled(1000));
}

}  // namespace insertion_test
