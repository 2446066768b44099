#include "dataflow/rays/next_stop.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <memory>

#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/trace/bundle_traversal.h"
#include "dataflow/distribution.h"
#include "dataflow/regions/balance.h"
#include "tests/support/scaled.h"
#include "tests/support/small_scenes.h"
#include "tests/support/surroundings.h"

namespace next_stops_test {

using namespace dmpc;
using core::RayMask;
using core::Traced;

namespace {

constexpr std::uint32_t region_count = 24;

/// A database cut into regions, with proxies of several sizes.
struct Land {
  explicit Land(const core::BuildOptions& options, std::size_t coarse_bytes)
      : database(core::build_database(tests::built_in("sombrero-1"), options)),
        settings{database.header(), core::Camera(tests::built_in("sombrero-1").view, database.header().frame, 8, 8, 1), {}},
        distribution(dataflow::distribute(database, settings,
                                          dataflow::equal_size_bsp(core::grid_size(settings.header.frame),
                                                                   dataflow::axes_facing(settings.camera), region_count))),
        coarse(core::proxy_of(database, coarse_bytes)) {}

  core::Database database;
  core::RenderSettings settings;
  dataflow::Distribution distribution;
  core::DatabasePart coarse, unknown = core::proxy_of(database, 0);
};

/// Up to 16 rays: neighbours, or of all places and directions, some of them along an axis.
void shoot(apps::Random& random, const Land& land, core::RayBundle& bundle) {
  const core::GridFrame& frame = land.settings.header.frame;
  const core::Corner size = core::grid_size(frame);
  const double spread = std::array{0.01, 0.2, 1.0}[random.below(3)];
  const core::Vec3d from = random.in_box(-0.3, 1.3), to = random.in_box(0, 1);
  const bool is_on_lattice = random.below(3) == 0;  // planes of several axes are crossed at once
  const auto place = [&](const core::Vec3d& about, std::size_t axis) {
    const double at = about[axis] + (2 * random.unit() - 1) * spread;
    return is_on_lattice ? std::round(16 * at) / 16 : at;
  };
  const auto kind = random.below(2) == 0 ? core::RayKind::primary : core::RayKind::shadow;
  bundle.count = random.below(core::bundle_rays_max) + 1;
  for (std::uint32_t i = 0; i < bundle.count; ++i) {
    core::Ray& ray = bundle.rays[i] = core::Ray{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = static_cast<double>(size[axis]) * double{frame.finest_cell};
      const double start = place(from, axis), end = place(to, axis);
      ray.origin[axis] = static_cast<float>(core::plane_at(frame, axis, 0) + extent * start);
      ray.direction[axis] = random.below(9) == 0 ? 0.0F : static_cast<float>(extent * (end - start));
    }
    ray.kind = kind;
    ray.t_max = random.below(3) == 0 ? static_cast<float>(2 * random.unit()) : ray.t_max;
  }
  bundle.start();
}

/// What became of rays that had left.
struct Seen {
  std::uint64_t stops = 0, passed = 0, hits = 0, misses = 0, stayed = 0;
  std::uint64_t bvh_nodes = 0, bvh_nodes_alone = 0;
};

/// Each ray of the bundle that has left goes on as it would alone.
void check_stops(core::RayBundle& bundle, const dataflow::Surroundings& surroundings, nodes::NodeId here, Seen& seen) {
  const RayMask left = bundle.left;
  std::array<core::Passage, core::bundle_rays_max> before;
  for (std::size_t ray = 0; ray < bundle.count; ++ray) {
    before[ray] = bundle.passage(ray);
  }
  core::Operations together, alone;
  core::Row<std::uint32_t> region;
  dataflow::find_next_stops(bundle, surroundings, here, together, region);
  CHECK((bundle.left & ~left) == 0);
  for (std::size_t ray = 0; ray < bundle.count; ++ray) {
    const RayMask bit = RayMask{1} << ray;
    if ((left & bit) == 0) {
      continue;
    }
    CAPTURE(ray);
    const auto expected = dataflow::next_stop(bundle.rays[ray], before[ray], surroundings, here, alone);
    CHECK(((bundle.left & bit) != 0) == (expected.traced == Traced::left));
    CHECK(bundle.hit(ray).t == before[ray].best.t);
    CHECK(bundle.hit(ray).primitive == before[ray].best.primitive);
    if (expected.traced == Traced::left) {
      const core::Passage passage = bundle.passage(ray);
      CHECK(region[ray] == expected.region);
      CHECK(std::bit_cast<std::uint64_t>(passage.t_enter) == std::bit_cast<std::uint64_t>(expected.passage.t_enter));
      CHECK(passage.cell == expected.passage.cell);
      CHECK(passage.entry_axis == expected.passage.entry_axis);
      seen.stops += 1;
      seen.passed += passage.t_enter > before[ray].t_enter ? 1 : 0;
      seen.stayed += surroundings.regions.owner_at(region[ray]) == here ? 1 : 0;
    } else {
      CHECK(((bundle.found & bit) != 0) == (expected.traced == Traced::hit));
      (expected.traced == Traced::hit ? seen.hits : seen.misses) += 1;
    }
  }
  CHECK(together.cell_steps == alone.cell_steps);
  CHECK(together.skipped.empty_regions == alone.skipped.empty_regions);
  CHECK(together.empty_cells == alone.empty_cells);
  seen.bvh_nodes += together.bvh_node_reads;
  seen.bvh_nodes_alone += alone.bvh_node_reads;
}

/// Rays walk in a region as a bundle, some with a candidate of before, and leave it.
Seen seen_in(const Land& land, std::uint64_t seed) {
  Seen seen;
  apps::Random random(seed);
  const auto bundle = std::make_unique<core::RayBundle>();
  const dataflow::Regions& regions = land.distribution.regions;
  for (std::size_t turn = 0; turn < tests::ray_count(3000); ++turn) {
    CAPTURE(turn);
    const nodes::NodeId here{random.below(region_count)}, there{random.below(2) == 0 ? nodes::index_of(here) : 0};
    const core::DatabasePart& part = land.distribution.parts[nodes::index_of(here)];
    shoot(random, land, *bundle);
    core::LocalRecords records(part.bytes);
    core::Operations operations;
    core::trace(*bundle, records, part.header, {}, operations);
    for (std::size_t ray = 0; ray < bundle->count; ++ray) {
      if ((bundle->left >> ray & 1U) != 0 && random.below(3) == 0) {
        bundle->best.set(ray, {static_cast<float>(bundle->t_enter[ray] + random.unit()), 7, core::Address{0}, 0});
        bundle->found |= RayMask{1} << ray;
      }
    }
    const core::DatabasePart* const proxy = std::array{&land.distribution.proxy, &land.coarse, &land.unknown}[turn % 3];
    check_stops(*bundle, tests::surroundings(regions, *proxy), there, seen);
  }
  return seen;
}

}  // namespace

TEST_CASE("rays that leave a region together stop, or end, where each of them does alone, for hardly more work") {
  const Land land({.cells_per_primitive = 1}, 3000);
  REQUIRE(land.coarse.record_bytes < land.distribution.proxy.record_bytes);
  const Seen seen = seen_in(land, 20'271);
  CHECK(seen.stops > 300);
  CHECK(seen.passed > 100);
  CHECK(seen.hits > 30);
  CHECK(seen.misses > 100);
  CHECK(seen.stayed > 10);
  CHECK(seen.bvh_nodes_alone > 1000);
  CHECK(seen.bvh_nodes < seen.bvh_nodes_alone * 21 / 20);  // children come in one order for all
}

TEST_CASE("so they do among voxels, and where the proxy has cubes of voxels") {
  const Land land({.structure = core::Structure::voxels, .voxels = {.voxels_per_primitive = 30}}, 4096);
  REQUIRE(land.coarse.header.directory_doublings > 0);
  const Seen seen = seen_in(land, 20'272);
  CHECK(seen.stops > 300);
  CHECK(seen.misses > 100);
}

}  // namespace next_stops_test
