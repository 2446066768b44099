#include "core/database/tree/bvh_builder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "apps/lab/bench/stability/listing.h"
#include "apps/lab/bench/stability/random.h"
#include "core/base/expect.h"
#include "core/database/tree/bvh_tree.h"
#include "core/record/records.h"
#include "tests/support/ids.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace bvh_builder_test {

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
std::vector<PrimitiveValues> shrinking(int count, bool has_kinds, float at = 1e18F) {
  std::vector<PrimitiveValues> primitives;
  for (int i = 0; i < count; ++i, at *= 0.9F) {
    const float near = at * 0.99F;
    primitives.push_back({PrimitiveKind::triangle, {at, at, at, near, at, at, near, near, at}});
    if (has_kinds && i % 2 == 1) {
      primitives.back() = {PrimitiveKind::sphere, {at, at, at, at * 0.01F}};
    }
  }
  return primitives;
}

/// Shrinking triangles, a sphere among them, and cones far around, so that a BVH node has few children to spare for the others.
std::vector<PrimitiveValues> of_three_kinds(int triangles, int cones) {
  std::vector<PrimitiveValues> primitives = shrinking(triangles, false, 1e9F);
  primitives.push_back({PrimitiveKind::sphere, {1e9F, 1e9F, 1e9F, 1e8F}});
  Random random(4);
  const auto somewhere = [&] { return static_cast<float>(random.in_box(0, 1e18).x); };
  for (int i = 0; i < cones; ++i) {
    const float x = somewhere(), y = somewhere(), z = somewhere();
    primitives.push_back({PrimitiveKind::cone, {x, y, z, 1e15F, x, y, z + 1e16F, 1e15F}});
  }
  return primitives;
}

BvhTree tree_of(const std::vector<PrimitiveValues>& primitives, int levels_max = bvh_levels_max) {
  std::vector<std::uint32_t> ids(primitives.size());
  std::iota(ids.begin(), ids.end(), 0U);
  const Parallel serial(1);
  return BvhBuilder(primitives, 0.0, {.finest_cell = 1e18F}, serial, levels_max).build({0, 0, 0}, ids);
}

int levels_of(const BvhNodeDraft& draft) {
  int below = 0;
  for (const BvhNodeDraft& bvh_node : draft.bvh_nodes) {
    below = std::max(below, levels_of(bvh_node));
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

TEST_CASE("a crowd in one place gets BVH nodes of its own, and lists stay short") {
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

TEST_CASE("BVH nodes are never deeper than a traversal can go, however small things get towards one side") {
  for (const bool has_kinds : {false, true}) {
    CAPTURE(has_kinds);
    const BvhTree tree = tree_of(shrinking(1000, has_kinds));
    CHECK(levels_of(tree.top) <= bvh_levels_max);
    CHECK(levels_of(tree.top) > 5);
    CHECK(are_all(tree.ids, 1000));
  }
}

TEST_CASE("as many primitives as BVH nodes hold find their place, of one kind or of three") {
  for (const int triangles : {511, 500, 480, 420, 360, 300, 200}) {
    CAPTURE(triangles);
    const BvhTree tree = tree_of(of_three_kinds(triangles, 511 - triangles), 3);
    CHECK(levels_of(tree.top) <= 3);
    CHECK(are_all(tree.ids, 512));
  }
  CHECK(levels_of(tree_of(shrinking(512, false), 3).top) <= 3);
}

TEST_CASE("more primitives in one place than BVH nodes hold have no room, and the message says how many have") {
  CHECK_THROWS_WITH_AS(tree_of(shrinking(513, false), 3), doctest::Contains("513 primitives lie in one place, at most 512 may"),
                       CapacityError);
  CHECK_THROWS_AS(tree_of(of_three_kinds(500, 12), 3), CapacityError);
}

TEST_CASE("a BVH node comes before its leaves, and these before its BVH nodes, each where its parent says") {
  BvhNodeDraft below{.bvh_node = {.child_count = 1}};
  below.leaves[0] = {.first = 1, .count = 2, .kind = PrimitiveKind::sphere};
  BvhTree tree{.top = {.bvh_node = {.child_count = 2}}, .ids = {2, 0, 1}};
  tree.top.leaves[1] = {.first = 0, .count = 1, .kind = PrimitiveKind::sphere};
  tree.top.bvh_nodes.push_back(below);
  std::vector<PrimitiveValues> primitives(3, {.kind = PrimitiveKind::sphere});
  for (std::size_t id = 0; id < primitives.size(); ++id) {
    primitives[id].value[0] = static_cast<float>(id);
  }
  const std::vector<ShadingReference> shading(3, ShadingReference::flat(7));
  RecordWriter writer(512);
  const Address top = tree.take_room(writer);
  writer.make_room();
  tree.write(primitives, shading, {}, writer);
  const std::vector<std::byte> bytes = std::move(writer).finish();
  const LocalRecords records(bytes);
  const auto first = read<BvhNode>(records.find(top));
  CHECK(first.child[1].is_leaf());
  REQUIRE_FALSE(first.child[0].is_leaf());
  CHECK(byte_offset(top) < byte_offset(first.child[1].address()));
  CHECK(byte_offset(first.child[1].address()) < byte_offset(first.child[0].address()));
  const auto second = read<BvhNode>(records.find(first.child[0].address()));
  const std::byte* const leaf = records.find(second.child[0].address());
  CHECK(read<LeafHeader>(leaf).count == 2);
  CHECK(read<float>(leaf + sizeof(LeafHeader) + 4) == 1.0F);
  CHECK(read<std::uint32_t>(leaf + sizeof(LeafHeader) + 4 * 10) == 0);
  CHECK(read<ShadingReference>(leaf + sizeof(LeafHeader) + 4 * 12).material() == 7);
}

}  // namespace bvh_builder_test
