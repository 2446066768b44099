#include "core/brick_builder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "apps/stability/listing.h"
#include "apps/stability/random.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// `count` triangles, spheres and cones through one point.
Scene heap(int count) {
  Random random(1);
  Scene scene;
  SceneBuilder builder(scene);
  for (int i = 0; i < count; ++i) {
    const Vec3d across = random.direction(), other = cross(across, random.direction());
    builder.polygon({across, other, (across + other) * -1.0});
    builder.sphere(random.direction() * 0.5, 0.5);
    builder.cone(across * -1.0, 0.1, across, 0.1);
  }
  return scene;
}

/// Triangles, or triangles and spheres in turn, each of them smaller and nearer to the origin than the one before.
std::vector<PrimitiveValues> shrinking(int count, bool has_kinds) {
  std::vector<PrimitiveValues> primitives;
  float at = 1e18F;
  for (int i = 0; i < count; ++i, at *= 0.9F) {
    const float near = at * 0.99F;
    primitives.push_back({PrimitiveKind::triangle, {at, at, at, near, at, at, near, near, at}});
    if (has_kinds && i % 2 == 1) {
      primitives.back() = {PrimitiveKind::sphere, {at, at, at, at * 0.01F}};
    }
  }
  return primitives;
}

int levels_of(const BrickDraft& draft) {
  int below = 0;
  for (const BrickDraft& brick : draft.bricks) {
    below = std::max(below, levels_of(brick));
  }
  return below + 1;
}

}  // namespace

TEST_CASE("however many primitives meet in a point, all are listed there") {
  for (const int count : {1, 2, 21, 22, 60, 200}) {
    CAPTURE(count);
    for (const std::size_t page_size : {std::size_t{512}, std::size_t{4096}}) {
      const Database database = build_database(heap(count), {.page_size_bytes = page_size});
      auto ids = Listing(database).around(to_local(database.header().frame, {0, 0, 0}));
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      std::size_t through = 0;
      for (std::uint32_t id = 0; id < database.primitives().size(); ++id) {
        through +=
            database.primitives()[id].kind != PrimitiveKind::cone && std::binary_search(ids.begin(), ids.end(), id) ? 1 : 0;
      }
      CHECK(through == 2 * static_cast<std::size_t>(count));
    }
  }
}

TEST_CASE("rays find the nearest of a heap") {
  const Database database = database_of(heap(100));
  const GridFrame& frame = database.header().frame;
  Random random(2);
  std::size_t differences = 0, hits = 0;
  for (std::size_t i = 0; i < scaled(5000); ++i) {
    const Ray ray = ray_through(to_local(frame, random.direction() * 2.0), to_local(frame, random.in_box(-0.3, 0.3)));
    const Hit hit = shoot(database, ray);
    differences += same_hit(hit, brute_force(database, ray)) ? 0 : 1;
    hits += hit.found() ? 1 : 0;
  }
  CHECK(differences == 0);
  CHECK(hits > 0);
}

TEST_CASE("a crowd in one place gets bricks of its own, and lists stay short") {
  Random random(3);
  Scene scene;
  SceneBuilder builder(scene);
  builder.polygon({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  for (std::size_t i = 0; i < scaled(20'000); ++i) {
    builder.sphere(Vec3d{0.5, 0.5, 0.5} + random.in_box(-0.01, 0.01), 1e-4);
  }
  const Database database = database_of(scene);
  const Listing listing(database);
  const auto ids = listing.around(to_local(database.header().frame, {0.5, 0.5, 0.5}));
  CHECK(ids.size() < 2000);
  CHECK(database.references() < 4 * database.primitives().size());
}

TEST_CASE("bricks are never deeper than a walk can go, however small things get towards one side") {
  for (const bool has_kinds : {false, true}) {
    CAPTURE(has_kinds);
    const auto primitives = shrinking(1000, has_kinds);
    std::vector<std::uint32_t> ids(primitives.size());
    std::iota(ids.begin(), ids.end(), 0U);
    const Parallel serial(1);
    const BrickTree tree = BrickBuilder(primitives, 0.0, 1e18F, serial).build({0, 0, 0}, ids);
    CHECK(levels_of(tree.top) <= brick_levels_max);
    CHECK(levels_of(tree.top) > 5);
    auto listed = tree.ids;
    std::sort(listed.begin(), listed.end());
    CHECK(listed == ids);
  }
}
