#include "core/database/meshes/copies_bounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/database/conversion.h"
#include "core/database/database.h"
#include "core/scene/detail.h"
#include "core/scene/frame.h"
#include "core/scene/instances.h"
#include "core/scene/placed_objects.h"
#include "tests/support/instanced_scene.h"
#include "tests/support/placed_meshes.h"

namespace dmpc::tests::copies_bounds_test {
namespace {

using core::Box;
using core::Scene;
using core::Transform;

struct Pair {
  Scene expanded, left;
};

Pair pair_of(const InstancedScene& made) {
  Pair pair{made.scene, made.scene};
  expand(pair.expanded, made.instances);
  leave(pair.left, made.instances);
  return pair;
}

bool same(const Box& a, const Box& b) { return a.low == b.low && a.high == b.high; }

Box bounds(const Scene& scene) { return bounds_of(scene, core::Parallel(1)); }

/// A rug of the size of 2 by 2 in these places.
InstancedScene rugs(const std::vector<Transform>& places) {
  InstancedScene made{in_floats(rug_on_floor(true, true, 6)), {}};
  made.instances.meshes = {{0, 73}};
  for (const Transform& world : places) {
    made.instances.places.push_back({world, 0, 73});
  }
  return made;
}

}  // namespace

TEST_CASE("a scene that leaves copies out has the bounds of the expanded one") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const Pair pair = pair_of(instanced_scene(seed));
    CHECK(same(bounds(pair.left), bounds(pair.expanded)));
  }
}

TEST_CASE("so it has of thousands of places next to each other, on however many threads") {
  apps::Random random(3);
  std::vector<Transform> places;
  for (int i = 0; i < 3000; ++i) {
    places.push_back(turned_place(random.between(0.01, 0.02), random.in_box(-1, 1), random.below(2) == 0));
  }
  const Pair pair = pair_of(rugs(places));
  const Box expected = bounds(pair.expanded);
  CHECK(same(bounds(pair.left), expected));
  CHECK(same(bounds_of(pair.left, core::Parallel(4)), expected));
}

TEST_CASE("what lies where no grid reaches does not count, nor does what is no number") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Transform here{}, far{.shift = {1e31, 0, 0}}, partly{.shift = {1e30, 0, 0}}, nowhere{.shift = {0, none, 0}};
  for (const auto& places : std::vector<std::vector<Transform>>{{here, far}, {far, far}, {partly, here}, {nowhere, here, here}}) {
    const Pair pair = pair_of(rugs(places));
    CHECK(same(bounds(pair.left), bounds(pair.expanded)));
  }
}

TEST_CASE("the grid's frame is the expanded scene's, its number of cells and where its detail lies") {
  int with_detail = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const Pair pair = pair_of(instanced_scene(seed));
    const Box box = bounds(pair.expanded);
    CHECK(object_count(pair.left) == pair.expanded.objects.size());
    const auto place = place_of_detail(pair.expanded, box);
    with_detail += place ? 1 : 0;
    CHECK(place_of_detail(pair.left, box) == place);
  }
  CHECK(with_detail > 5);
}

TEST_CASE("of more objects than are looked at for detail the same ones are looked at") {
  apps::Random random(11);
  std::vector<Transform> places;
  for (int i = 0; i < 2000; ++i) {  // 146,000 objects, of which those of one place are large
    places.push_back(turned_place(1e-4 * random.between(0.5, 1), random.in_box(0.2, 0.205), i % 2 == 0));
  }
  places.push_back(turned_place(1, {}, false));
  const Pair pair = pair_of(rugs(places));
  const Box box = bounds(pair.expanded);
  const auto place = place_of_detail(pair.expanded, box);
  REQUIRE(place);
  CHECK(place_of_detail(pair.left, box) == place);
}

TEST_CASE("a database is the expanded scene's, to the last byte") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    CAPTURE(seed);
    const Pair pair = pair_of(instanced_scene(seed));
    const core::Database expected = build_database(pair.expanded, {.threads = 1});
    for (const core::Database& one :
         {build_database(pair.left, {.threads = 1}), build_database(Scene(pair.left), {.threads = 1})}) {
      REQUIRE(one.bytes().size() == expected.bytes().size());
      CHECK(std::equal(one.bytes().begin(), one.bytes().end(), expected.bytes().begin()));
      CHECK(one.header().frame.origin == expected.header().frame.origin);
    }
  }
}

}  // namespace dmpc::tests::copies_bounds_test
